-- Wireshark dissector for the captures of `fauxboard tap --pcapng`: names every code and field of the line between a
-- control board and its touch screen, or its host.
--
--     wireshark -X lua_script:tools/fauxboard.lua capture.pcapng
--     tshark -X lua_script:tools/fauxboard.lua -r capture.pcapng -Y 'fauxboard.board.l2.t0 > 200'
--
-- A field's filter has the key it has on the wire, and a second one the name it is shown with: what a host asks is
-- under `fauxboard.host`, a screen's requests under `fauxboard.screen`.
--
--     tshark ... -T fields -e frame.time_relative -e fauxboard.board.ok_t.nozzle -e fauxboard.board.ok_t.bed_target
--
-- or copy this file to the folder of personal Lua plugins (Help, About, Folders).
--
-- A packet is a line of the wire, in the link type for serial lines (LINKTYPE_RTAC_SERIAL): the event "data sent"
-- is what the board says, "data received" what it is told. Wireshark's own dissector of that link type shows its 12
-- bytes; what follows them is taken apart here, by the same rules as `fauxboard decode` does it.
--
-- At the end of this file: what passes on the wires to a UV panel, as `fauxboard run --spi FILE.pcapng` has it
-- (LINKTYPE_USER5), every packet and command by its name:
--
--     tshark -X lua_script:tools/fauxboard.lua -r panel.pcapng -Y 'fauxboard_spi.wrong == 1'

local proto = Proto("fauxboard", "Control board and touch screen or host")
local header_bytes = 12
local events = { [1] = "board", [2] = "screen" }

-- What the other end is called: "screen" from the first line on that only a screen's line carries.
local peer = "host"
function proto.init() peer = "host" end

-- BEGIN CODES: made from the catalogue in protocol/; test_tools says when this is out of date, and with
-- FAUXBOARD_UPDATE=1 in the environment it makes it anew.
local codes = {
    board = {
        { code = "//", words = true, title = "file", meaning = "Name of the file written.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "//############Error!cann't open file", words = true, title = "file not opened", meaning = "Answer to M23.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "//#####Error!cann't open file", words = true, title = "no start-up file", meaning = "Of the console at power-on.", fields = {} },
        { code = "//Disk init fail!", words = true, title = "no stick", meaning = "There is no stick, or it cannot be read.", fields = {} },
        { code = "//action:", words = true, title = "host action", meaning = "What the host should do.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "//action:prompt_begin", words = true, title = "question", meaning = "To the host's user; its buttons follow.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "//action:prompt_button", words = true, title = "button", meaning = "Of the question; M876 S answers with its number.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "//action:prompt_end", words = true, title = "question is over", meaning = "The host takes it away.", fields = {} },
        { code = "//action:prompt_show", words = true, title = "question is whole", meaning = "The host shows it.", fields = {} },
        { code = "Begin file list", words = true, title = "file list begins", meaning = "Files and sizes follow.", fields = {} },
        { code = "Brown out Reset", words = true, title = "reset", meaning = "Why the board started.", fields = {} },
        { code = "Cap:", words = true, title = "capability", meaning = "What the firmware was built with; 0 without, 1 with.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "Delete failed :", words = true, title = "no file to delete", meaning = "There was no such file.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "Done printing file", words = true, title = "print finished", meaning = "The file's end was reached.", fields = {} },
        { code = "Done saving file!", words = true, title = "file written", meaning = "A file of the stick is whole.", fields = {} },
        { code = "Done saving file.", words = true, title = "file written", meaning = "Answer to M29.", fields = {} },
        { code = "End file list", words = true, title = "file list ends", meaning = "No more files.", fields = {} },
        { code = "Error!", words = true, title = "refused", meaning = "The request cannot be done.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "Error:", words = true, title = "refused", meaning = "The request cannot be done.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "External Reset", words = true, title = "reset", meaning = "Why the board started.", fields = {} },
        { code = "FIRMWARE_NAME:", words = true, title = "identity", meaning = "Answer to M115.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "FR:", words = true, title = "print speed", meaning = "Answer to M220.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "File deleted :", words = true, title = "file deleted", meaning = "A file of the stick is gone.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "File opened:", words = true, title = "file opened", meaning = "Answer to M23: name and size.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "File selected", words = true, title = "file selected", meaning = "Answer to M23.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "Marlin", words = true, title = "firmware", meaning = "Its version.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "Not SD printing", words = true, title = "no print", meaning = "Answer to M27.", fields = {} },
        { code = "PowerUp", words = true, title = "power-on", meaning = "Why the board started.", fields = {} },
        { code = "Resend:", words = true, title = "again, please", meaning = "The number of the line wanted next.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "SD N:", words = true, title = "SD progress", meaning = "ChiTu 4.4.3: the first piece of the answer to M27.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "SD printing byte", words = true, title = "SD progress", meaning = "Answer to M27, sent without frame.", fields = {
            { key = "", name = "at", kind = "integer" },
            { key = "/", name = "of", kind = "integer", unit = "bytes" },
        } },
        { code = "Software Reset", words = true, title = "reset", meaning = "Why the board started.", fields = {} },
        { code = "Start Print:", words = true, title = "print started", meaning = "Answer to M24, sent without frame.", fields = {
            { key = "", name = "file", kind = "text", meaning = "volume and path: SD1:/A30T/cube.gco" },
        } },
        { code = "Stats:", words = true, title = "print statistics", meaning = "Answer to M78.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "Stop Print", words = true, title = "print stopped", meaning = "Answer to M2103, sent without frame.", fields = {} },
        { code = "T:", words = true, title = "temperatures", meaning = "Of a wait for a heater, or a report (M155).", fields = {
            { key = "", name = "nozzle", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "B:", name = "bed", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "C:", name = "chamber", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "T0:", name = "extruder 0", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "T1:", name = "extruder 1", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "@:", name = "nozzle power", kind = "integer", unit = "of 127" },
            { key = "B@:", name = "bed power", kind = "integer", unit = "of 127" },
            { key = "W:", name = "must hold for", kind = "text", meaning = "whole seconds; ? while it is not there" },
        } },
        { code = "UART1 init OK", words = true, title = "power-on", meaning = "Of the console.", fields = {} },
        { code = "USB disk_OK", words = true, title = "stick is there", meaning = "Of the console at power-on.", fields = {} },
        { code = "USB disk_ok", words = true, title = "stick put in", meaning = "Of the console.", fields = {} },
        { code = "Watchdog Reset", words = true, title = "reset", meaning = "Why the board started.", fields = {} },
        { code = "Writing to file:", words = true, title = "upload begins", meaning = "Answer to M28.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "X:", words = true, title = "position", meaning = "Answer to M114, also behind moves of their own; or a report (M154).", fields = {
            { key = "", name = "X", kind = "number", unit = "mm" },
            { key = "Y:", name = "Y", kind = "number", unit = "mm" },
            { key = "Z:", name = "Z", kind = "number", unit = "mm" },
            { key = "E:", name = "E", kind = "number", unit = "mm" },
            { key = "Count", name = "steps", kind = "text" },
        } },
        { code = "byte", words = true, title = "SD progress", meaning = "ChiTu 4.4.3: the place in the file, and its size.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "chitu_initial_file_autorun!", words = true, title = "no start-up file", meaning = "Of the console at power-on.", fields = {} },
        { code = "echo:", words = true, title = "message", meaning = "For the user.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "echo:Now fresh file:", words = true, title = "file chosen", meaning = "Ahead of what M23 and M28 say.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "echo:Unknown command:", words = true, title = "unknown command", meaning = "The board does not know it.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "echo:busy:", words = true, title = "busy", meaning = "The board is at work, or waits for its user; it has heard.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "ok", words = true, title = "acknowledged", meaning = "The request was taken; what it asked for stands behind.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "ok B:", words = true, title = "status", meaning = "Answer to M4000.", fields = {
            { key = "", name = "bed", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "E1:", name = "nozzle 1", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "E2:", name = "nozzle 2", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "X:", name = "X", kind = "number", unit = "mm" },
            { key = "Y:", name = "Y", kind = "number", unit = "mm" },
            { key = "Z:", name = "Z", kind = "number", unit = "mm" },
            { key = "F:", name = "LED fan", kind = "integer", unit = "of 256" },
            { key = "/", name = "board fan", kind = "integer", unit = "of 256" },
            { key = "D:", name = "at", kind = "integer", unit = "bytes" },
            { key = "/", name = "of", kind = "integer", unit = "bytes", meaning = "0: no print" },
            { key = "/", name = "halted", kind = "integer", meaning = "1 while paused, and without a print" },
            { key = "T:", name = "print time", kind = "integer", unit = "s" },
        } },
        { code = "ok C:", words = true, title = "position", meaning = "Answer to M114.", fields = {
            { key = "X:", name = "X", kind = "number", unit = "mm" },
            { key = "Y:", name = "Y", kind = "number", unit = "mm" },
            { key = "Z:", name = "Z", kind = "number", unit = "mm" },
            { key = "E:", name = "E", kind = "number", unit = "mm" },
        } },
        { code = "ok T:", words = true, title = "temperatures", meaning = "Answer to M105.", fields = {
            { key = "", name = "nozzle", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "B:", name = "bed", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "C:", name = "chamber", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "T0:", name = "extruder 0", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "T1:", name = "extruder 1", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "@:", name = "nozzle power", kind = "integer", unit = "of 127" },
            { key = "B@:", name = "bed power", kind = "integer", unit = "of 127" },
            { key = "W:", name = "must hold for", kind = "text", meaning = "whole seconds; ? while it is not there" },
        } },
        { code = "open failed, File :", words = true, title = "file not opened", meaning = "Answer to M23.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "resend", words = true, title = "again, please", meaning = "A piece of an upload is wrong or not the next: its place.", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "start", words = true, title = "power-on", meaning = "Of the console.", fields = {} },
        { code = "start_task", words = true, title = "power-on", meaning = "Of the console.", fields = {} },
        { code = "L1", title = "position", meaning = "Position and feedrate.", fields = {
            { key = "X", name = "X", kind = "number", unit = "mm", meaning = "end of the last move accepted by the planner, not the moving head (C)" },
            { key = "Y", name = "Y", kind = "number", unit = "mm" },
            { key = "Z", name = "Z", kind = "number", unit = "mm", meaning = "without the babystep (C)" },
            { key = "E", name = "E", kind = "number", unit = "mm", meaning = "in the document, never seen from a board" },
            { key = "F", name = "feedrate", kind = "integer", unit = "mm/s", meaning = "of the move being executed, truncated; keeps its last value when idle (C)" },
        } },
        { code = "L2", title = "temperatures", meaning = "Temperatures, storage, fans and speed, sent when one of them changed.", fields = {
            { key = "B:", name = "bed", kind = "number", unit = "°C", meaning = "printed with the fraction mirrored on an A30T: P = 2 ceil(T) - T (C)" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "/", name = "heating", kind = "flag", values = { [0] = "off", [1] = "on" } },
            { key = "T0:", name = "extruder 0", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "/", name = "heating", kind = "flag", values = { [0] = "off", [1] = "on" } },
            { key = "T1:", name = "extruder 1", kind = "number", unit = "°C", meaning = "an A30T has no sensor there; an A30 leaves T1 and T2 out" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "/", name = "heating", kind = "flag", values = { [0] = "off", [1] = "on" } },
            { key = "T2:", name = "extruder 2", kind = "number", unit = "°C" },
            { key = "/", name = "target", kind = "number", unit = "°C" },
            { key = "/", name = "heating", kind = "flag", values = { [0] = "off", [1] = "on" } },
            { key = "SD:", name = "storage", kind = "integer", values = { [0] = "SD card present", [1] = "no SD card", [2] = "SD card failed", [16] = "SD card present, no U-disk", [17] = "no SD card, no U-disk", [18] = "SD card failed, no U-disk", [32] = "SD card present, U-disk failed", [33] = "no SD card, U-disk failed", [34] = "SD card failed, U-disk failed" }, meaning = "low nibble SD card, high nibble U-disk" },
            { key = "F0:", name = "part fan", kind = "integer", unit = "%" },
            { key = "F2:", name = "board fan", kind = "integer", unit = "%", meaning = "fixed at 50 on an A30T" },
            { key = "R:", name = "print speed", kind = "integer", unit = "%", meaning = "10..800" },
            { key = "FR:", name = "feedrate", kind = "integer", unit = "mm/s", meaning = "the same value as F of L1" },
        } },
        { code = "L3", title = "print status", meaning = "State of the print job and of the machine.", fields = {
            { key = "PS:", name = "print status", kind = "integer", values = { [0] = "idle", [1] = "printing", [2] = "paused", [3] = "recovery", [4] = "finished" } },
            { key = "VL:", name = "volume", kind = "integer", values = { [0] = "from the SD card", [1] = "from the U-disk" } },
            { key = "MT:", name = "motors", kind = "integer", values = { [0] = "motors off", [1] = "motors on" }, meaning = "a change sends L3 in the next slot (C)" },
            { key = "FT:", name = "filament", kind = "integer", values = { [0] = "no filament", [1] = "filament present", [255] = "filament detector off" } },
            { key = "AL:", name = "auto leveling", kind = "integer", values = { [0] = "auto leveling off", [1] = "auto leveling on" } },
            { key = "ST:", name = "probe", kind = "integer", values = { [0] = "capacitive probe", [1] = "3D Touch", [254] = "capacitive probe only" } },
            { key = "WF:", name = "WiFi", kind = "integer", values = { [0] = "no WiFi", [1] = "WiFi fitted" } },
            { key = "MR:", name = "mixing ratio", kind = "integer", form = "mixing", meaning = "100 = all E0, 25600 = all E1, 6553600 = all E2: percent of E0 + 256 x E1 + 65536 x E2" },
            { key = "FN:", name = "file name", kind = "text", meaning = "the A30 screen wants ` PG:` after it and drops 50 characters and more" },
            { key = "PG:", name = "progress", kind = "integer", unit = "%", meaning = "0..100" },
            { key = "TM:", name = "time", kind = "integer", unit = "s", meaning = "since the start of the print" },
            { key = "LA:", name = "layer", kind = "integer" },
            { key = "LC:", name = "layer count", kind = "integer" },
        } },
        { code = "L4", title = "WiFi", meaning = "State of the WiFi module.", fields = {
            { key = "WT:", name = "WiFi", kind = "flag", values = { [0] = "off", [1] = "on" } },
            { key = "CF:", name = "auto connect", kind = "flag", values = { [0] = "off", [1] = "on" } },
            { key = "AP:", name = "access point set-up", kind = "flag", values = { [0] = "off", [1] = "on" } },
            { key = "SS:", name = "server", kind = "integer", values = { [0] = "server off", [1] = "server on", [2] = "server connected" } },
            { key = "RS:", name = "signal", kind = "integer", meaning = "0 none, 1..5" },
            { key = "RE:", name = "router", kind = "integer", values = { [0] = "router off", [1] = "router on", [2] = "router connected" } },
            { key = "RI:", name = "router address", kind = "text", closing = ":" },
            { key = "RA:", name = "network name", kind = "text", closing = ":" },
            { key = "SA:", name = "server address", kind = "text", closing = ":" },
        } },
        { code = "L5", title = "print speed", meaning = "The print speed set; the A30 screen misreads it, the A30T board never sends it.", fields = {
            { key = "S", name = "speed", kind = "integer", unit = "%" },
        } },
        { code = "L6", title = "fan", meaning = "A fan's speed; the A30 screen misreads it, the A30T board never sends it.", fields = {
            { key = "P", name = "fan", kind = "integer", values = { [0] = "part fan", [1] = "board fan" } },
            { key = "S", name = "speed", kind = "integer", unit = "%" },
        } },
        { code = "L7", title = "file list", meaning = "One line of a file list: begin, entries, end.", fields = {
            { key = "begin file list:", name = "begin of the list", kind = "integer", values = { [0] = "begins, SD card", [1] = "begins, U-disk" } },
            { key = "end file list:", name = "end of the list", kind = "integer", values = { [0] = "ends, SD card", [1] = "ends, U-disk" } },
            { key = "P", name = "entry", kind = "integer", meaning = "from 0; a folder is not marked" },
            { key = "", name = "name", kind = "text", meaning = "the first entry of a folder is Main/FOLDER, the way back" },
        } },
        { code = "L8", title = "screen firmware file", meaning = "A firmware file for the screen follows.", answer = "M2121", fields = {
            { key = ":", name = "firmware file", kind = "text", closing = ";", meaning = "must hold `bin` (F)" },
        } },
        { code = "L9", title = "identity", meaning = "Names and versions of the board, for the about page.", fields = {
            { key = "DN:", name = "device", kind = "text", closing = ";" },
            { key = "DM:", name = "model", kind = "text", closing = ";" },
            { key = "SN:", name = "serial number", kind = "text", closing = ";", meaning = "16 bytes of erased flash (0xFF) on the recorded board" },
            { key = "FV:", name = "firmware", kind = "text", closing = ";" },
            { key = "PV:", name = "print volume", kind = "text", closing = ";" },
            { key = "HV:", name = "hardware", kind = "text", closing = ";" },
        } },
        { code = "L10", title = "manual leveling", meaning = "Height reached, after every M2107.", fields = {
            { key = "S", name = "Z", kind = "number", unit = "mm" },
            { key = "X", name = "endstop adjustment X", kind = "number", unit = "mm", meaning = "X and all that follow: delta printers only" },
            { key = "Y", name = "endstop adjustment Y", kind = "number", unit = "mm" },
            { key = "Z", name = "endstop adjustment Z", kind = "number", unit = "mm" },
            { key = "H", name = "print height", kind = "number", unit = "mm" },
            { key = "O", name = "delta radius error", kind = "number", unit = "mm" },
            { key = "R", name = "delta radius", kind = "number", unit = "mm" },
            { key = "D", name = "diagonal rod", kind = "number", unit = "mm" },
            { key = "F", name = "smooth rod offset", kind = "number", unit = "mm" },
        } },
        { code = "L11", title = "auto leveling", meaning = "The probe's Z offset.", fields = {
            { key = "P", name = "what", kind = "integer", values = { [0] = "probe" }, meaning = "always 0" },
            { key = "S", name = "Z offset", kind = "number", unit = "mm" },
        } },
        { code = "L12", title = "extruder", meaning = "State of loading and unloading; also the end of a long action.", fields = {
            { key = "P", name = "what", kind = "integer", values = { [0] = "machine" }, meaning = "always 0" },
            { key = "S", name = "state", kind = "integer", values = { [0] = "done", [1] = "retract 10 mm", [2] = "loading", [3] = "unloading", [5] = "cleaning" }, meaning = "0 also ends a homing and a wait for a temperature (C)" },
        } },
        { code = "L13", title = "disk selection", meaning = "Answer to M2115.", fields = {
            { key = "", name = "message", kind = "text", meaning = "`Disk select success`" },
        } },
        { code = "L14", title = "message", meaning = "Text for the print page.", fields = {
            { key = "", name = "message", kind = "text", meaning = "M117's text with its leading blank; the A30 screen shows up to 39 characters" },
        } },
        { code = "L15", title = "filament detector", meaning = "Reserved: boards answer with L3.", fields = {
            { key = "S", name = "filament detector", kind = "flag", values = { [0] = "off", [1] = "on" } },
        } },
        { code = "L16", title = "restart", meaning = "Offers to resume after a power loss, or restarts the screen.", answer = "M2130", fields = {
            { key = "P", name = "what", kind = "integer", values = { [0] = "power-loss recovery", [1] = "screen" } },
            { key = "", name = "offer", kind = "integer", when = 0, meaning = "15: a saved print can be resumed (F)" },
            { key = "S", name = "state", kind = "integer", when = 0 },
            { key = "S", name = "do", kind = "integer", when = 1, values = { [0] = "restart" } },
        } },
        { code = "L17", title = "motor move", meaning = "Reserved.", fields = {
            { key = "S", name = "result", kind = "integer", meaning = "reserved" },
        } },
        { code = "L18", title = "exception", meaning = "Opens a page for something out of order.", fields = {
            { key = "P", name = "page", kind = "integer", values = { [26] = "message page" } },
            { key = "S", name = "exception", kind = "integer", values = { [0] = "no filament", [1] = "SD card removed", [2] = "resume the interrupted print?", [3] = "file not found", [4] = "hotend temperature abnormal", [5] = "bed temperature abnormal", [6] = "hotend temperature abnormal, print stopped", [7] = "bed temperature abnormal, print stopped", [8] = "hotend temperature abnormal, stop the print", [9] = "bed temperature abnormal, stop the print", [10] = "cannot open the file", [11] = "3D Touch alarm: check and retry", [12] = "hotend too cold to change filament", [13] = "not available while printing", [14] = "stop the PID tuning?", [15] = "waiting for the user" }, meaning = "15 and above crash an A30 screen, 16 and above show an empty question" },
        } },
        { code = "L19", title = "closed-loop steppers", meaning = "State of the stepper control boards.", fields = {
            { key = "P", name = "what", kind = "integer", values = { [0] = "mode", [1] = "command", [2] = "report" } },
            { key = "S", name = "state", kind = "integer" },
            { key = "C", name = "motor or command", kind = "integer" },
            { key = "D", name = "value", kind = "integer" },
            { key = "SM:", name = "motor", kind = "integer", when = 2 },
            { key = "TC:", name = "calibration error", kind = "number", unit = "°", when = 2 },
            { key = "ED:", name = "enable level", kind = "integer", when = 2 },
            { key = "DI:", name = "direction level", kind = "integer", when = 2, meaning = "the document's name" },
            { key = "DP:", name = "direction level", kind = "integer", when = 2, meaning = "the name the A30 screen reads" },
            { key = "MS:", name = "microsteps", kind = "integer", when = 2 },
            { key = "MC:", name = "largest current", kind = "integer", unit = "mA", when = 2 },
            { key = "HC:", name = "holding current", kind = "integer", unit = "mA", when = 2 },
        } },
        { code = "L20", title = "screen firmware update", meaning = "Starts the update of the screen.", answer = "M2100", fields = {
            { key = "S", name = "step", kind = "integer", values = { [0] = "start" } },
        } },
        { code = "L21", title = "question to the screen", meaning = "Repeated until the screen has told its version.", answer = "M2134", fields = {
            { key = "P", name = "what", kind = "integer", values = { [0] = "screen" } },
            { key = "S", name = "question", kind = "integer", values = { [0] = "firmware version?" } },
        } },
        { code = "L22", title = "mixing", meaning = "Mixing mode, ratio and template.", fields = {
            { key = "MS:", name = "mode", kind = "integer", values = { [0] = "mixing off", [256] = "fixed ratio", [512] = "template", [768] = "ratio by height" }, meaning = "256 x S of M2138; the lower byte is the kind within the mode" },
            { key = "MR:", name = "mixing ratio", kind = "integer", form = "mixing", meaning = "100 = all E0, 25600 = all E1, 6553600 = all E2: percent of E0 + 256 x E1 + 65536 x E2" },
            { key = "SP:", name = "start ratio", kind = "integer", form = "mixing", meaning = "100 = all E0, 25600 = all E1, 6553600 = all E2: percent of E0 + 256 x E1 + 65536 x E2" },
            { key = "EP:", name = "end ratio", kind = "integer", form = "mixing", meaning = "100 = all E0, 25600 = all E1, 6553600 = all E2: percent of E0 + 256 x E1 + 65536 x E2" },
            { key = "SH:", name = "start height", kind = "number", unit = "mm" },
            { key = "EH:", name = "end height", kind = "number", unit = "mm" },
        } },
        { code = "L23", title = "add-ons", meaning = "Sound, backlight, screen lock.", fields = {
            { key = "SE:", name = "sound", kind = "flag", values = { [0] = "sound off", [1] = "sound on" } },
            { key = "BE:", name = "backlight setting", kind = "flag", values = { [0] = "backlight setting off", [1] = "backlight setting on" } },
            { key = "BP:", name = "backlight", kind = "integer", unit = "%", meaning = "1..100" },
            { key = "CE:", name = "screen lock", kind = "flag", values = { [0] = "screen lock off", [1] = "screen lock on" } },
            { key = "HE:", name = "hotend correction", kind = "flag", values = { [0] = "hotend correction off", [1] = "hotend correction on" } },
            { key = "SP:", name = "password", kind = "integer", meaning = "four digits, leading zeros left out" },
            { key = "ST:", name = "lock after", kind = "integer", unit = "s" },
            { key = "HC:", name = "correction centre", kind = "integer", unit = "°C" },
            { key = "HO:", name = "correction", kind = "integer", unit = "°C" },
        } },
        { code = "L24", title = "settings", meaning = "One page of settings, named by P.", fields = {
            { key = "P", name = "page", kind = "integer", values = { [0] = "steps per mm", [1] = "velocities", [2] = "accelerations", [3] = "jerk", [4] = "unknown page", [5] = "babystep", [6] = "home offsets" } },
            { key = "A", name = "X", kind = "number", unit = "steps/mm", when = 0 },
            { key = "B", name = "Y", kind = "number", unit = "steps/mm", when = 0 },
            { key = "C", name = "Z", kind = "number", unit = "steps/mm", when = 0 },
            { key = "D", name = "E", kind = "number", unit = "steps/mm", when = 0 },
            { key = "A", name = "X", kind = "number", unit = "mm/s", when = 1 },
            { key = "B", name = "Y", kind = "number", unit = "mm/s", when = 1 },
            { key = "C", name = "Z", kind = "number", unit = "mm/s", when = 1 },
            { key = "D", name = "E", kind = "number", unit = "mm/s", when = 1 },
            { key = "E", name = "least", kind = "number", unit = "mm/s", when = 1 },
            { key = "F", name = "least travel", kind = "number", unit = "mm/s", when = 1 },
            { key = "A", name = "printing", kind = "number", unit = "mm/s²", when = 2, meaning = "T says steps/s², but 500 of those would be 6 mm/s²" },
            { key = "B", name = "retract", kind = "number", unit = "mm/s²", when = 2 },
            { key = "C", name = "X", kind = "number", unit = "mm/s²", when = 2 },
            { key = "D", name = "Y", kind = "number", unit = "mm/s²", when = 2 },
            { key = "E", name = "Z", kind = "number", unit = "mm/s²", when = 2 },
            { key = "F", name = "E", kind = "number", unit = "mm/s²", when = 2 },
            { key = "A", name = "X", kind = "number", unit = "mm/s", when = 3 },
            { key = "B", name = "Y", kind = "number", unit = "mm/s", when = 3 },
            { key = "C", name = "Z", kind = "number", unit = "mm/s", when = 3 },
            { key = "D", name = "E", kind = "number", unit = "mm/s", when = 3 },
            { key = "A", name = "Z", kind = "number", unit = "mm", when = 5 },
            { key = "A", name = "Z0", kind = "number", unit = "mm", when = 6 },
            { key = "B", name = "Z1", kind = "number", unit = "mm", when = 6 },
        } },
        { code = "M2107", title = "manual leveling", meaning = "Answer to M2107, sent without frame before L10.", fields = {
            { key = "Z:", name = "Z", kind = "number", unit = "mm" },
            { key = "ok", name = "point reached", kind = "word" },
            { key = "fail", name = "point not reached", kind = "word" },
            { key = "save success", name = "saved", kind = "word" },
        } },
        { code = "M2121", title = "screen firmware update", meaning = "Announces a firmware file.", answer = "M2121", fields = {
            { key = "start:", name = "firmware file", kind = "text", closing = ";", meaning = "must hold `bin`" },
        } },
    },
    screen = {
        { code = "M99999", words = true, title = "discovery", meaning = "ChiTu: who is there?", answer = "ok MAC:", fields = {} },
        { code = "U100", words = true, title = "network name", meaning = "ChiTu: what the printer is called in the network.", answer = "ok N:", fields = {
            { key = "", name = "name", kind = "text" },
        } },
        { code = "log", words = true, title = "screen log", meaning = "A message at the screen's power-up, never framed.", fields = {
            { key = "", name = "message", kind = "text" },
        } },
        { code = "strXPT2046_TouchPara:", words = true, title = "touch calibration", meaning = "Debug output of the A30 screen.", fields = {
            { key = "", name = "values", kind = "text" },
        } },
        { code = "x:", words = true, title = "touch point", meaning = "Debug output of the A30 screen: x:n,y:n;", fields = {
            { key = "", name = "point", kind = "text" },
        } },
        { code = "G0", title = "move", meaning = "Travel to a position.", answer = "L1", fields = {
            { key = "X", name = "X", kind = "number", unit = "mm" },
            { key = "Y", name = "Y", kind = "number", unit = "mm" },
            { key = "Z", name = "Z", kind = "number", unit = "mm" },
            { key = "E", name = "E", kind = "number", unit = "mm" },
            { key = "F", name = "feedrate", kind = "number", unit = "mm/min" },
            { key = "I", name = "move", kind = "integer", values = { [0] = "relative" }, meaning = "of ChiTu's hosts" },
        } },
        { code = "G1", title = "move", meaning = "Move, extruding or not.", answer = "L1", fields = {
            { key = "X", name = "X", kind = "number", unit = "mm" },
            { key = "Y", name = "Y", kind = "number", unit = "mm" },
            { key = "Z", name = "Z", kind = "number", unit = "mm" },
            { key = "E", name = "E", kind = "number", unit = "mm" },
            { key = "F", name = "feedrate", kind = "number", unit = "mm/min" },
            { key = "I", name = "move", kind = "integer", values = { [0] = "relative" }, meaning = "of ChiTu's hosts" },
        } },
        { code = "G2", title = "arc", meaning = "Move on an arc, clockwise.", answer = "L1", fields = {
            { key = "X", name = "X", kind = "number", unit = "mm" },
            { key = "Y", name = "Y", kind = "number", unit = "mm" },
            { key = "Z", name = "Z", kind = "number", unit = "mm" },
            { key = "I", name = "I", kind = "number", unit = "mm" },
            { key = "J", name = "J", kind = "number", unit = "mm" },
            { key = "R", name = "radius", kind = "number", unit = "mm" },
            { key = "E", name = "E", kind = "number", unit = "mm" },
            { key = "F", name = "feedrate", kind = "number", unit = "mm/min" },
        } },
        { code = "G3", title = "arc", meaning = "Move on an arc, counter-clockwise.", answer = "L1", fields = {
            { key = "X", name = "X", kind = "number", unit = "mm" },
            { key = "Y", name = "Y", kind = "number", unit = "mm" },
            { key = "Z", name = "Z", kind = "number", unit = "mm" },
            { key = "I", name = "I", kind = "number", unit = "mm" },
            { key = "J", name = "J", kind = "number", unit = "mm" },
            { key = "R", name = "radius", kind = "number", unit = "mm" },
            { key = "E", name = "E", kind = "number", unit = "mm" },
            { key = "F", name = "feedrate", kind = "number", unit = "mm/min" },
        } },
        { code = "G4", title = "wait", meaning = "Do nothing for a time.", fields = {
            { key = "S", name = "time", kind = "number", unit = "s" },
            { key = "P", name = "time", kind = "number", unit = "ms" },
        } },
        { code = "G28", title = "home", meaning = "Home the axes named, all when none is.", answer = "L1, L12", fields = {
            { key = "X", name = "X", kind = "word" },
            { key = "Y", name = "Y", kind = "word" },
            { key = "Z", name = "Z", kind = "word" },
            { key = "E", name = "E", kind = "word" },
        } },
        { code = "G29", title = "probe the bed", meaning = "Measure the bed on its grid.", answer = "L1", fields = {} },
        { code = "G90", title = "absolute coordinates", meaning = "Moves that follow name their end.", fields = {} },
        { code = "G91", title = "relative coordinates", meaning = "Moves that follow name their way.", fields = {} },
        { code = "G92", title = "set position", meaning = "Call the present place by these coordinates.", fields = {
            { key = "X", name = "X", kind = "number", unit = "mm" },
            { key = "Y", name = "Y", kind = "number", unit = "mm" },
            { key = "Z", name = "Z", kind = "number", unit = "mm" },
            { key = "E", name = "E", kind = "number", unit = "mm" },
        } },
        { code = "L1", title = "move step", meaning = "Step of the screen's move page.", fields = {
            { key = "S", name = "step", kind = "integer", values = { [0] = "30 mm", [1] = "10 mm", [2] = "1 mm", [3] = "0.5 mm", [4] = "0.1 mm" } },
        } },
        { code = "L2", title = "leveling step", meaning = "Step of the screen's auto-level page.", fields = {
            { key = "S", name = "step", kind = "integer", values = { [0] = "10 mm", [1] = "1 mm", [2] = "0.1 mm", [3] = "0.05 mm" } },
        } },
        { code = "L101", title = "manual leveling left", meaning = "Back to the usual status frames.", fields = {} },
        { code = "M0", title = "continue", meaning = "The user has confirmed, after L18 P26 S15.", answer = "L3", fields = {} },
        { code = "M17", title = "motors on", meaning = "Power the motors.", answer = "L3", fields = {
            { key = "X", name = "X", kind = "word" },
            { key = "Y", name = "Y", kind = "word" },
            { key = "Z", name = "Z", kind = "word" },
            { key = "E", name = "E", kind = "word" },
        } },
        { code = "M18", title = "motors off", meaning = "Release the motors; the position is lost.", answer = "L3", fields = {
            { key = "X", name = "X", kind = "word" },
            { key = "Y", name = "Y", kind = "word" },
            { key = "Z", name = "Z", kind = "word" },
            { key = "E", name = "E", kind = "word" },
            { key = "S", name = "after", kind = "number", unit = "s" },
        } },
        { code = "M20", title = "list files", meaning = "Ask for the file list; plain text when LCD and file: are missing.", answer = "L7", fields = {
            { key = "LCD", name = "for the screen", kind = "word" },
            { key = "file:", name = "folder", kind = "text", meaning = "volume and path: SD1:/A30T" },
        } },
        { code = "M21", title = "mount the card", meaning = "Take the SD card into use.", answer = "L2", fields = {} },
        { code = "M22", title = "release the card", meaning = "Let the SD card go.", answer = "L2", fields = {} },
        { code = "M23", title = "select file", meaning = "Select a file to print.", answer = "L14, or L18 P26 S3 or S10", fields = {
            { key = "", name = "file", kind = "text", meaning = "relative to the folder shown; the A30 screen leaves our L7's checksum on it (F)" },
        } },
        { code = "M24", title = "start or resume", meaning = "Start the file selected, or go on with it.", answer = "Start Print:, L3", fields = {} },
        { code = "M25", title = "pause", meaning = "Pause the print.", answer = "L3", fields = {} },
        { code = "M26", title = "set file position", meaning = "Go on from this byte of the file.", fields = {
            { key = "S", name = "at", kind = "integer", unit = "bytes" },
        } },
        { code = "M27", title = "SD progress query", meaning = "Ask how far the file is read.", answer = "SD printing byte", fields = {} },
        { code = "M28", title = "upload", meaning = "ChiTu: a file is written from here on.", answer = "ok N:", fields = {
            { key = "", name = "file", kind = "text" },
        } },
        { code = "M29", title = "upload's end", meaning = "ChiTu: the file written is closed.", answer = "Done saving file!", fields = {} },
        { code = "M30", title = "delete file", meaning = "ChiTu: removes a file of the stick.", answer = "File deleted :, Delete failed :", fields = {
            { key = "", name = "file", kind = "text" },
        } },
        { code = "M33", title = "stop", meaning = "ChiTu: stops the print.", answer = "ok N:", fields = {
            { key = "I", name = "unknown", kind = "number" },
        } },
        { code = "M48", title = "probe repeatability", meaning = "Probes one place again and again.", answer = "Mean:", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "M73", title = "set progress", meaning = "The slicer's own word for how far the print is.", answer = "ok", fields = {
            { key = "P", name = "progress", kind = "number", unit = "%" },
            { key = "R", name = "left", kind = "number", unit = "min" },
        } },
        { code = "M75", title = "start the print's timer", meaning = "For the statistics.", answer = "ok", fields = {} },
        { code = "M76", title = "pause the print's timer", meaning = "For the statistics; a host may pause as well.", answer = "ok", fields = {} },
        { code = "M77", title = "stop the print's timer", meaning = "For the statistics.", answer = "ok", fields = {} },
        { code = "M78", title = "print statistics", meaning = "How many prints, how long, how much filament.", answer = "Stats:", fields = {} },
        { code = "M82", title = "absolute extrusion", meaning = "E names an end.", fields = {} },
        { code = "M83", title = "relative extrusion", meaning = "E names a length.", fields = {} },
        { code = "M84", title = "motors off", meaning = "As M18.", answer = "L3", fields = {
            { key = "X", name = "X", kind = "word" },
            { key = "Y", name = "Y", kind = "word" },
            { key = "Z", name = "Z", kind = "word" },
            { key = "E", name = "E", kind = "word" },
            { key = "S", name = "after", kind = "number", unit = "s" },
        } },
        { code = "M92", title = "steps per mm", meaning = "Set steps per mm.", answer = "L24 P0", fields = {
            { key = "X", name = "X", kind = "number", unit = "steps/mm" },
            { key = "Y", name = "Y", kind = "number", unit = "steps/mm" },
            { key = "Z", name = "Z", kind = "number", unit = "steps/mm" },
            { key = "E", name = "E", kind = "number", unit = "steps/mm" },
        } },
        { code = "M104", title = "nozzle", meaning = "Set the nozzle's target.", answer = "L2", fields = {
            { key = "S", name = "target", kind = "number", unit = "°C", meaning = "0: off" },
            { key = "T", name = "extruder", kind = "integer" },
        } },
        { code = "M105", title = "temperature query", meaning = "Ask for temperatures.", answer = "L2", fields = {} },
        { code = "M106", title = "fan", meaning = "Set a fan's speed.", answer = "L6 by the document; A30T boards show it in L2", fields = {
            { key = "P", name = "fan", kind = "integer", values = { [0] = "part fan", [1] = "board fan", [2] = "second fan" } },
            { key = "S", name = "speed", kind = "integer", unit = "of 255", meaning = "0..255" },
        } },
        { code = "M107", title = "fan off", meaning = "Stop a fan.", answer = "L6 by the document; A30T boards show it in L2", fields = {
            { key = "P", name = "fan", kind = "integer", values = { [0] = "part fan", [1] = "board fan", [2] = "second fan" } },
        } },
        { code = "M108", title = "break off", meaning = "End heating or PID tuning, after L18 P26 S14.", answer = "L3", fields = {} },
        { code = "M109", title = "nozzle, wait", meaning = "Set the nozzle's target and wait for it.", answer = "L2", fields = {
            { key = "S", name = "target", kind = "number", unit = "°C", meaning = "0: off" },
            { key = "R", name = "target, also cooling down", kind = "number", unit = "°C" },
            { key = "T", name = "extruder", kind = "integer" },
        } },
        { code = "M110", title = "line number", meaning = "The number that the next line counts from.", answer = "ok N:", fields = {
            { key = "N", name = "number", kind = "number" },
        } },
        { code = "M112", title = "emergency stop", meaning = "Heaters and motors off, the job ends.", answer = "L3", fields = {} },
        { code = "M113", title = "keepalive", meaning = "How often a waiting host is told so.", answer = "ok", fields = {
            { key = "S", name = "every", kind = "number", unit = "s", meaning = "0: never" },
        } },
        { code = "M114", title = "position query", meaning = "Ask for the position.", answer = "L1", fields = {} },
        { code = "M115", title = "identity query", meaning = "Ask for names and versions.", answer = "L9", fields = {} },
        { code = "M117", title = "message", meaning = "Show a text on the screen.", answer = "L14", fields = {
            { key = "", name = "message", kind = "text" },
        } },
        { code = "M118", title = "say", meaning = "The board says the text.", answer = "the text", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "M125", title = "park and pause", meaning = "The head parks and the board waits for its user.", answer = "ok", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "M140", title = "bed", meaning = "Set the bed's target.", answer = "L2", fields = {
            { key = "S", name = "target", kind = "number", unit = "°C", meaning = "0: off" },
            { key = "T", name = "extruder", kind = "integer" },
        } },
        { code = "M154", title = "position reports", meaning = "The position comes by itself.", answer = "ok", fields = {
            { key = "S", name = "every", kind = "number", unit = "s", meaning = "0: never" },
        } },
        { code = "M155", title = "temperature reports", meaning = "Temperatures come by themselves.", answer = "ok", fields = {
            { key = "S", name = "every", kind = "number", unit = "s", meaning = "0: never" },
        } },
        { code = "M163", title = "mixing weight", meaning = "Set one weight of the mix being made.", fields = {
            { key = "S", name = "extruder", kind = "integer" },
            { key = "P", name = "weight", kind = "number" },
        } },
        { code = "M164", title = "store the mix", meaning = "Keep the mix as a tool.", fields = {
            { key = "S", name = "tool", kind = "integer" },
        } },
        { code = "M165", title = "mixing ratio", meaning = "Set all weights at once.", answer = "L22 in its slot, when changed", fields = {
            { key = "A", name = "E0", kind = "number", meaning = "weights, normalised to percent" },
            { key = "B", name = "E1", kind = "number" },
            { key = "C", name = "E2", kind = "number" },
            { key = "D", name = "E3", kind = "number" },
        } },
        { code = "M166", title = "mixing gradient", meaning = "Change the mix with the height.", fields = {
            { key = "A", name = "from height", kind = "number", unit = "mm" },
            { key = "Z", name = "to height", kind = "number", unit = "mm" },
            { key = "I", name = "from tool", kind = "integer" },
            { key = "J", name = "to tool", kind = "integer" },
            { key = "S", name = "gradient", kind = "flag", values = { [0] = "off", [1] = "on" } },
            { key = "T", name = "tool", kind = "integer" },
        } },
        { code = "M190", title = "bed, wait", meaning = "Set the bed's target and wait for it.", answer = "L2", fields = {
            { key = "S", name = "target", kind = "number", unit = "°C", meaning = "0: off" },
            { key = "R", name = "target, also cooling down", kind = "number", unit = "°C" },
            { key = "T", name = "extruder", kind = "integer" },
        } },
        { code = "M201", title = "largest accelerations", meaning = "Set the axes' accelerations.", fields = {
            { key = "X", name = "X", kind = "number", unit = "mm/s²" },
            { key = "Y", name = "Y", kind = "number", unit = "mm/s²" },
            { key = "Z", name = "Z", kind = "number", unit = "mm/s²" },
            { key = "E", name = "E", kind = "number", unit = "mm/s²" },
        } },
        { code = "M203", title = "largest velocities", meaning = "Set the axes' velocities.", fields = {
            { key = "X", name = "X", kind = "number", unit = "mm/s" },
            { key = "Y", name = "Y", kind = "number", unit = "mm/s" },
            { key = "Z", name = "Z", kind = "number", unit = "mm/s" },
            { key = "E", name = "E", kind = "number", unit = "mm/s" },
        } },
        { code = "M204", title = "accelerations", meaning = "Set the accelerations used.", fields = {
            { key = "P", name = "printing", kind = "number", unit = "mm/s²" },
            { key = "R", name = "retract", kind = "number", unit = "mm/s²" },
            { key = "T", name = "travel", kind = "number", unit = "mm/s²" },
            { key = "S", name = "printing and travel", kind = "number", unit = "mm/s²" },
        } },
        { code = "M205", title = "jerk", meaning = "Set jerk and least velocities.", fields = {
            { key = "X", name = "X", kind = "number", unit = "mm/s" },
            { key = "Y", name = "Y", kind = "number", unit = "mm/s" },
            { key = "Z", name = "Z", kind = "number", unit = "mm/s" },
            { key = "E", name = "E", kind = "number", unit = "mm/s" },
            { key = "S", name = "least", kind = "number", unit = "mm/s" },
            { key = "T", name = "least travel", kind = "number", unit = "mm/s" },
        } },
        { code = "M211", title = "soft end stops", meaning = "Whether moves end at the volume's borders.", answer = "ok", fields = {
            { key = "S", name = "recovery", kind = "flag", values = { [0] = "off", [1] = "on" } },
        } },
        { code = "M220", title = "print speed", meaning = "Scale all feedrates.", answer = "L5 by the document; A30T boards show it in L2", fields = {
            { key = "S", name = "speed", kind = "integer", unit = "%", meaning = "10..999" },
        } },
        { code = "M221", title = "flow", meaning = "Scale the extrusion.", fields = {
            { key = "S", name = "flow", kind = "integer", unit = "%" },
        } },
        { code = "M290", title = "babystep", meaning = "Set the babystep.", answer = "L24 P5", fields = {
            { key = "Z", name = "Z", kind = "number", unit = "mm", meaning = "the whole offset, not a step; refused until homed (C)" },
        } },
        { code = "M300", title = "beep", meaning = "ChiTu: a tone.", answer = "ok N:", fields = {
            { key = "S", name = "pitch", kind = "number", unit = "Hz" },
            { key = "P", name = "time", kind = "number", unit = "ms" },
        } },
        { code = "M301", title = "nozzle PID", meaning = "The controller's constants.", answer = "ok", fields = {
            { key = "P", name = "P", kind = "number" },
            { key = "I", name = "I", kind = "number" },
            { key = "D", name = "D", kind = "number" },
        } },
        { code = "M302", title = "cold extrusion", meaning = "How warm a nozzle must be for filament to move.", answer = "ok", fields = {
            { key = "S", name = "least", kind = "number", unit = "°C" },
            { key = "P", name = "cold extrusion", kind = "flag", values = { [0] = "off", [1] = "on" } },
        } },
        { code = "M303", title = "PID tuning", meaning = "Finds the constants of a heater's controller.", answer = "PID Autotune start", fields = {
            { key = "E", name = "heater", kind = "integer", meaning = "-1: the bed" },
            { key = "S", name = "target", kind = "number", unit = "°C" },
            { key = "C", name = "cycles", kind = "integer" },
            { key = "U", name = "use the result", kind = "word" },
        } },
        { code = "M304", title = "bed PID", meaning = "The controller's constants.", answer = "ok", fields = {
            { key = "P", name = "P", kind = "number" },
            { key = "I", name = "I", kind = "number" },
            { key = "D", name = "D", kind = "number" },
        } },
        { code = "M306", title = "model predictive control", meaning = "Constants of the nozzle's model, or T: finds them.", answer = "ok", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "M400", title = "finish moves", meaning = "Wait until all moves are done.", fields = {} },
        { code = "M410", title = "quick stop", meaning = "Drops all moves, at once.", answer = "ok", fields = {} },
        { code = "M412", title = "runout sensor", meaning = "Whether the sensor ends a print without filament.", answer = "ok", fields = {
            { key = "S", name = "sensor", kind = "flag", values = { [0] = "off", [1] = "on" } },
            { key = "D", name = "distance", kind = "number", unit = "mm" },
        } },
        { code = "M413", title = "power-loss recovery", meaning = "Whether a print can be taken up again after a power cut.", answer = "ok", fields = {
            { key = "S", name = "recovery", kind = "flag", values = { [0] = "off", [1] = "on" } },
        } },
        { code = "M420", title = "leveling", meaning = "Switches the mesh on and off, or shows it.", answer = "ok", fields = {
            { key = "S", name = "leveling", kind = "flag", values = { [0] = "off", [1] = "on" } },
            { key = "Z", name = "fade height", kind = "number", unit = "mm" },
            { key = "V", name = "print the mesh", kind = "word" },
        } },
        { code = "M486", title = "cancel objects", meaning = "Objects of a print are left out from here on.", answer = "ok", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "M500", title = "save settings", meaning = "Write the settings to the EEPROM.", fields = {} },
        { code = "M501", title = "load settings", meaning = "Read the settings from the EEPROM.", fields = {} },
        { code = "M502", title = "factory settings", meaning = "Set all settings to their defaults.", fields = {} },
        { code = "M503", title = "settings query", meaning = "Every setting as a command that sets it.", answer = "all settings", fields = {} },
        { code = "M524", title = "stop the print", meaning = "The print from the card ends.", answer = "ok", fields = {} },
        { code = "M600", title = "change filament", meaning = "Stop for a change of filament.", answer = "L3", fields = {
            { key = "E", name = "retract", kind = "number", unit = "mm" },
            { key = "L", name = "unload", kind = "number", unit = "mm" },
            { key = "X", name = "X", kind = "number", unit = "mm" },
            { key = "Y", name = "Y", kind = "number", unit = "mm" },
            { key = "Z", name = "lift", kind = "number", unit = "mm" },
        } },
        { code = "M701", title = "load filament", meaning = "Moves filament in, and asks whether to purge more.", answer = "ok", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "M702", title = "unload filament", meaning = "Moves filament out.", answer = "ok", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "M808", title = "repeat marker", meaning = "A file goes back to it so often.", answer = "ok", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "M851", title = "probe offset", meaning = "Where the probe is, seen from the nozzle.", answer = "ok", fields = {
            { key = "X", name = "X", kind = "number", unit = "mm" },
            { key = "Y", name = "Y", kind = "number", unit = "mm" },
            { key = "Z", name = "Z", kind = "number", unit = "mm" },
        } },
        { code = "M876", title = "answer a question", meaning = "The host's user has chosen a button.", answer = "ok", fields = {
            { key = "S", name = "button", kind = "integer", meaning = "0 is the first" },
        } },
        { code = "M900", title = "linear advance", meaning = "The extruder's lead.", answer = "ok", fields = {
            { key = "K", name = "K", kind = "number" },
        } },
        { code = "M928", title = "log to a file", meaning = "What comes is written to a file and carried out.", answer = "ok", fields = {
            { key = "", name = "text", kind = "text" },
        } },
        { code = "M997", title = "restart", meaning = "The board starts anew.", answer = "ok", fields = {} },
        { code = "M999", title = "go on after a stop", meaning = "The board takes commands again.", answer = "Resend:", fields = {} },
        { code = "M1000", title = "take the print up again", meaning = "After a power cut.", answer = "ok", fields = {} },
        { code = "M2011", title = "home offset", meaning = "Change the home offset of one of two Z motors.", answer = "L24 P6", fields = {
            { key = "P", name = "motor", kind = "integer", values = { [0] = "Z0", [1] = "Z1" } },
            { key = "S", name = "offset", kind = "number", unit = "mm", meaning = "added to the present one; 0 clears it" },
        } },
        { code = "M2100", title = "screen firmware update", meaning = "Hand-shake of the update of the screen.", answer = "L20, L8", fields = {
            { key = "S", name = "step", kind = "integer", values = { [0] = "start, from the PC", [1] = "screen ready", [2] = "done or given up", [4] = "failed, once more", [5] = "screen started" } },
        } },
        { code = "M2101", title = "print status query", meaning = "Ask for the print status.", answer = "L3", fields = {
            { key = "LCD", name = "for the screen", kind = "word" },
        } },
        { code = "M2103", title = "stop the print", meaning = "Stop the print, heaters off.", answer = "Stop Print, L3", fields = {} },
        { code = "M2105", title = "filament", meaning = "Load, unload, clean, stop.", answer = "L12", fields = {
            { key = "S", name = "do", kind = "integer", values = { [0] = "feed 10 mm", [1] = "retract 10 mm", [2] = "load until stopped", [3] = "unload until stopped", [4] = "stop", [5] = "clean until stopped" } },
        } },
        { code = "M2106", title = "filament detector", meaning = "Switch the filament detector.", answer = "L3", fields = {
            { key = "P", name = "what", kind = "integer", values = { [0] = "filament detector" } },
            { key = "S", name = "detector", kind = "flag", values = { [0] = "off", [1] = "on" } },
        } },
        { code = "M2107", title = "manual leveling", meaning = "One step of manual leveling.", answer = "M2107, L10", fields = {
            { key = "S", name = "do", kind = "integer", values = { [0] = "home and go to the start height", [1] = "point 1, rear right", [2] = "point 2, rear left", [3] = "point 3, front left", [4] = "point 4, front right", [5] = "point 5, centre", [6] = "Z up 0.5 mm", [7] = "Z down 0.5 mm", [8] = "save", [9] = "Z down 0.05 mm", [10] = "Z up 0.05 mm", [11] = "leave", [12] = "adjust the delta's endstops", [13] = "home the delta" } },
        } },
        { code = "M2111", title = "motor move", meaning = "Reserved.", fields = {
            { key = "S", name = "do", kind = "integer", values = { [0] = "motors on", [1] = "motors off", [2] = "move X", [3] = "move Y", [4] = "move Z" } },
            { key = "X", name = "by", kind = "number", unit = "mm", when = 2 },
            { key = "Y", name = "by", kind = "number", unit = "mm", when = 3 },
            { key = "Z", name = "by", kind = "number", unit = "mm", when = 4 },
        } },
        { code = "M2115", title = "disk selection", meaning = "Choose the disk to list.", answer = "L13", fields = {
            { key = "S", name = "disk", kind = "integer", values = { [0] = "SD card", [1] = "U-disk" } },
        } },
        { code = "M2120", title = "auto leveling", meaning = "One step of auto leveling.", answer = "L11; L1 for moves", fields = {
            { key = "P", name = "what", kind = "integer", values = { [0] = "leveling", [1] = "probe pin", [2] = "save the Z offset", [3] = "Z up", [4] = "Z down", [5] = "Z offset query", [6] = "to the centre", [7] = "measure at the centre", [9] = "kind of probe" } },
            { key = "S", name = "leveling", kind = "flag", when = 0, values = { [0] = "off", [1] = "on" } },
            { key = "S", name = "pin", kind = "integer", when = 1, values = { [0] = "up", [1] = "down", [2] = "alarm release" } },
            { key = "S", name = "Z offset", kind = "number", unit = "mm", when = 2 },
            { key = "S", name = "step", kind = "integer", when = 3, values = { [0] = "10 mm", [1] = "1 mm", [2] = "0.1 mm", [3] = "0.05 mm" } },
            { key = "S", name = "step", kind = "integer", when = 4, values = { [0] = "10 mm", [1] = "1 mm", [2] = "0.1 mm", [3] = "0.05 mm" } },
            { key = "S", name = "what", kind = "integer", when = 6, values = { [0] = "nozzle", [1] = "probe" } },
            { key = "S", name = "what", kind = "integer", when = 7, values = { [0] = "probe" } },
            { key = "S", name = "kind", kind = "integer", when = 9, values = { [0] = "capacitive", [1] = "3D Touch" } },
        } },
        { code = "M2121", title = "screen firmware file", meaning = "The screen has taken the file, or not.", fields = {
            { key = "ok", name = "file taken", kind = "word" },
            { key = "fail", name = "file not taken", kind = "word" },
        } },
        { code = "M2130", title = "power-loss recovery", meaning = "Resume or discard the saved print.", answer = "L3", fields = {
            { key = "P", name = "what", kind = "integer", values = { [0] = "saved print", [1] = "screen" } },
            { key = "S", name = "do", kind = "integer", when = 0, values = { [0] = "discard", [1] = "resume" } },
            { key = "S", name = "do", kind = "integer", when = 1, values = { [0] = "restart" } },
        } },
        { code = "M2131", title = "WiFi", meaning = "Set the WiFi module, or ask for its state.", answer = "L4", fields = {
            { key = "P", name = "what", kind = "integer", values = { [0] = "WiFi", [1] = "auto connect", [2] = "access point set-up" }, meaning = "none: ask for the state" },
            { key = "S", name = "state", kind = "flag", values = { [0] = "off", [1] = "on" } },
        } },
        { code = "M2132", title = "closed-loop steppers", meaning = "Set the stepper control boards.", answer = "L19", fields = {
            { key = "P", name = "what", kind = "integer", values = { [0] = "mode", [1] = "command", [2] = "report" } },
            { key = "C", name = "motor", kind = "integer", when = 0 },
            { key = "D", name = "closed loop", kind = "flag", when = 0, values = { [0] = "off", [1] = "on" } },
            { key = "C", name = "command", kind = "integer", when = 1, values = { [0] = "calibrate", [1] = "test calibration", [2] = "enable level", [3] = "direction level", [4] = "microsteps", [5] = "largest current", [6] = "holding current", [7] = "read position", [8] = "PID", [9] = "error limit", [10] = "factory settings", [11] = "set zero" } },
            { key = "D", name = "value 1", kind = "number", when = 1 },
            { key = "E", name = "value 2", kind = "number", when = 1 },
            { key = "F", name = "value 3", kind = "number", when = 1 },
        } },
        { code = "M2133", title = "exception page", meaning = "Ask for a page.", answer = "L18", fields = {
            { key = "P", name = "page", kind = "integer" },
            { key = "S", name = "exception", kind = "integer" },
        } },
        { code = "M2134", title = "screen version", meaning = "The screen's firmware version, after L21.", answer = "L9", fields = {
            { key = "FW:", name = "firmware", kind = "text" },
        } },
        { code = "M2135", title = "mixing ratio", meaning = "Set the mixing ratio.", answer = "L22", fields = {
            { key = "P", name = "ratio, or tool", kind = "integer", form = "mixing", meaning = "100 = all E0, 25600 = all E1, 6553600 = all E2: percent of E0 + 256 x E1 + 65536 x E2" },
            { key = "S", name = "percent", kind = "integer", unit = "%" },
        } },
        { code = "M2136", title = "mixing template", meaning = "Select a mixing template.", answer = "L22", fields = {
            { key = "S", name = "template", kind = "integer", meaning = "1..8 ready-made, 1..6 custom" },
        } },
        { code = "M2137", title = "mixing range", meaning = "Set start and end of the custom template; each may come alone.", answer = "L22", fields = {
            { key = "A", name = "start ratio", kind = "integer", form = "mixing", meaning = "100 = all E0, 25600 = all E1, 6553600 = all E2: percent of E0 + 256 x E1 + 65536 x E2" },
            { key = "B", name = "end ratio", kind = "integer", form = "mixing", meaning = "100 = all E0, 25600 = all E1, 6553600 = all E2: percent of E0 + 256 x E1 + 65536 x E2" },
            { key = "C", name = "start height", kind = "number", unit = "mm" },
            { key = "D", name = "end height", kind = "number", unit = "mm" },
        } },
        { code = "M2138", title = "mixing mode", meaning = "Switch mixing.", answer = "L22", fields = {
            { key = "S", name = "mode", kind = "integer", values = { [0] = "off", [1] = "fixed ratio", [2] = "ready-made template", [3] = "template" }, meaning = "x 256 is MS: of L22" },
        } },
        { code = "M2139", title = "add-ons", meaning = "Set sound, backlight, lock, or ask for them.", answer = "L23", fields = {
            { key = "P", name = "what", kind = "integer", values = { [0] = "sound", [1] = "backlight", [2] = "screen lock", [3] = "hotend correction" }, meaning = "none: ask for the state" },
            { key = "S", name = "sound", kind = "flag", when = 0, values = { [0] = "off", [1] = "on" } },
            { key = "S", name = "backlight setting", kind = "flag", when = 1, values = { [0] = "off", [1] = "on" } },
            { key = "E", name = "brightness", kind = "integer", unit = "%", when = 1, meaning = "0..100" },
            { key = "S", name = "lock", kind = "flag", when = 2, values = { [0] = "off", [1] = "on" } },
            { key = "W", name = "password", kind = "integer", when = 2, meaning = "four digits, leading zeros left out" },
            { key = "E", name = "lock after", kind = "integer", unit = "s", when = 2 },
            { key = "A", name = "correction", kind = "number", unit = "°C", when = 3 },
            { key = "B", name = "centre", kind = "number", unit = "°C", when = 3 },
        } },
        { code = "M2140", title = "settings query", meaning = "Ask for a page of settings, or restore them.", answer = "L24", fields = {
            { key = "S", name = "page", kind = "integer", values = { [0] = "steps per mm", [1] = "velocities", [2] = "accelerations", [3] = "jerk", [4] = "unknown page", [5] = "babystep", [6] = "home offsets" } },
            { key = "R", name = "restore", kind = "integer", values = { [0] = "stored settings back" } },
        } },
        { code = "M3000", title = "block query", meaning = "ChiTu: the next block of a download.", answer = "a block", fields = {
            { key = "I", name = "from byte", kind = "number" },
        } },
        { code = "M3001", title = "block query", meaning = "ChiTu: a block of a download again.", answer = "a block", fields = {
            { key = "I", name = "from byte", kind = "number" },
        } },
        { code = "M4000", title = "status query", meaning = "ChiTu: heaters, height, fans, place in the file.", answer = "ok B:", fields = {} },
        { code = "M4001", title = "parameter query", meaning = "ChiTu: steps, volume, charset.", answer = "ok X:", fields = {} },
        { code = "M4002", title = "version query", meaning = "ChiTu: the firmware's version.", answer = "ok V", fields = {} },
        { code = "M4003", title = "power off", meaning = "ChiTu: switches the printer off.", answer = "ok N:", fields = {} },
        { code = "M4004", title = "block query", meaning = "ChiTu: which command blocks.", answer = "ok C:", fields = {} },
        { code = "M4006", title = "file query", meaning = "ChiTu: the name of the file printed.", answer = "ok '", fields = {} },
        { code = "M4012", title = "upload query", meaning = "ChiTu: how much of an upload came.", answer = "ok", fields = {
            { key = "I", name = "what", kind = "number" },
            { key = "T", name = "size", kind = "number", unit = "bytes" },
        } },
        { code = "M5000", title = "authorisation", meaning = "ChiTu: a word of 16 bytes.", answer = "Error:auth", fields = {
            { key = "", name = "word", kind = "text" },
        } },
        { code = "M5002", title = "identity query", meaning = "ChiTu: three words of the processor.", answer = "0x", fields = {} },
        { code = "M6030", title = "print file", meaning = "ChiTu: opens a file and prints it.", answer = "ok N:", fields = {
            { key = "", name = "file", kind = "text" },
        } },
        { code = "M6032", title = "open file", meaning = "ChiTu: opens a file for download.", answer = "ok L:", fields = {
            { key = "", name = "file", kind = "text" },
        } },
        { code = "M6040", title = "restart", meaning = "ChiTu: restarts the board.", fields = {
            { key = "I", name = "after", kind = "number", unit = "ms" },
        } },
        { code = "M8004", title = "motor direction", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "Z", kind = "number" },
        } },
        { code = "M8005", title = "what Z moves", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "Z", name = "Z", kind = "number" },
        } },
        { code = "M8006", title = "starting speed", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "speed", kind = "number", unit = "mm/s" },
        } },
        { code = "M8007", title = "jerk", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "speed", kind = "number", unit = "mm/s" },
        } },
        { code = "M8008", title = "acceleration", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "acceleration", kind = "number", unit = "mm/s²" },
        } },
        { code = "M8010", title = "step of Z", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "S", name = "length", kind = "number", unit = "mm" },
        } },
        { code = "M8013", title = "highest speed of Z", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "speed", kind = "number", unit = "mm/s" },
        } },
        { code = "M8015", title = "first speeds", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "homing", kind = "number", unit = "mm/s" },
            { key = "P", name = "slow lift", kind = "number", unit = "mm/s" },
            { key = "T", name = "slow lift", kind = "number", unit = "mm/s" },
        } },
        { code = "M8016", title = "second speeds", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "homing", kind = "number", unit = "mm/s" },
            { key = "P", name = "fast lift", kind = "number", unit = "mm/s" },
            { key = "T", name = "fast lift", kind = "number", unit = "mm/s" },
            { key = "D", name = "wait", kind = "number", unit = "ms" },
        } },
        { code = "M8020", title = "withdrawal", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "S", name = "length", kind = "number", unit = "mm" },
        } },
        { code = "M8021", title = "consumable", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "S", name = "diameter", kind = "number", unit = "mm" },
        } },
        { code = "M8026", title = "travel of Z", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "height", kind = "number", unit = "mm" },
        } },
        { code = "M8028", title = "wire back", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "S", name = "length", kind = "number", unit = "mm" },
        } },
        { code = "M8029", title = "end stops", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "type", kind = "number" },
            { key = "T", name = "wiring", kind = "number" },
            { key = "S", name = "side", kind = "number" },
            { key = "C", name = "after homing", kind = "number" },
        } },
        { code = "M8030", title = "fans and LED", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "fan of the LED", kind = "number" },
            { key = "T", name = "fan of the board", kind = "number" },
            { key = "S", name = "LED", kind = "number" },
            { key = "C", name = "after homing", kind = "number" },
        } },
        { code = "M8034", title = "folders", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "support", kind = "number" },
        } },
        { code = "M8070", title = "lifts and projector", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "Z", name = "lift", kind = "number", unit = "mm" },
            { key = "S", name = "slowly", kind = "number", unit = "mm" },
            { key = "T", name = "warm-up", kind = "number", unit = "s" },
            { key = "I", name = "speed of the line", kind = "number", unit = "baud" },
        } },
        { code = "M8071", title = "resolution", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "X", name = "X", kind = "number", unit = "pixels" },
            { key = "Y", name = "Y", kind = "number", unit = "pixels" },
        } },
        { code = "M8083", title = "zero", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "off the end stop", kind = "number" },
        } },
        { code = "M8084", title = "zero offset", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "Z", name = "Z", kind = "number", unit = "mm" },
        } },
        { code = "M8085", title = "screen", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "logo", kind = "number", unit = "ms" },
            { key = "T", name = "saver after", kind = "number", unit = "s" },
        } },
        { code = "M8087", title = "external driver", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "I", name = "settling", kind = "number", unit = "ns" },
            { key = "T", name = "holding", kind = "number", unit = "ns" },
        } },
        { code = "M8093", title = "diagnostics", meaning = "ChiTu: writes a file of status and settings.", answer = "Done saving file!", fields = {
            { key = "I", name = "what", kind = "number" },
        } },
        { code = "M8489", title = "after a print", meaning = "ChiTu: a setting.", answer = "ok N:", fields = {
            { key = "P", name = "action", kind = "number" },
        } },
        { code = "M8500", title = "save settings", meaning = "ChiTu: keeps the settings.", answer = "ok N:", fields = {} },
        { code = "M8510", title = "use settings", meaning = "ChiTu: puts the settings into use, unsaved.", answer = "ok N:", fields = {} },
        { code = "M8511", title = "saved settings", meaning = "ChiTu: takes the saved settings back.", answer = "ok N:", fields = {} },
        { code = "M8512", title = "backup", meaning = "ChiTu: writes the settings into a file.", answer = "Done saving file!", fields = {
            { key = "", name = "file", kind = "text" },
        } },
        { code = "M8513", title = "factory settings", meaning = "ChiTu: forgets all settings.", answer = "ok N:", fields = {} },
        { code = "M9003", title = "join a network", meaning = "ChiTu: WiFi as a client.", answer = "ok N:", fields = {
            { key = "", name = "name and password", kind = "text" },
        } },
        { code = "M9005", title = "open a network", meaning = "ChiTu: WiFi as an access point.", answer = "ok N:", fields = {
            { key = "", name = "name and password", kind = "text" },
        } },
        { code = "T0", title = "tool 0", meaning = "Select extruder 0, or its mix.", answer = "L22", fields = {} },
        { code = "T1", title = "tool 1", meaning = "Select extruder 1, or its mix.", answer = "L22", fields = {} },
        { code = "T2", title = "tool 2", meaning = "Select extruder 2, or its mix.", answer = "L22", fields = {} },
        { code = "T3", title = "tool 3", meaning = "Select extruder 3, or its mix.", answer = "L22", fields = {} },
    },
}
-- END CODES

-- ---- tables for looking up ----

local by_code = { board = {}, screen = {} }
local by_words = { board = {}, screen = {} }
local fields = {}

local general = {
    direction = ProtoField.string("fauxboard.direction", "Direction"),
    line = ProtoField.string("fauxboard.line", "Line"),
    code = ProtoField.string("fauxboard.code", "Code"),
    title = ProtoField.string("fauxboard.title", "Title"),
    meaning = ProtoField.string("fauxboard.meaning", "Meaning"),
    answer = ProtoField.string("fauxboard.answer", "Answered by"),
    words = ProtoField.string("fauxboard.words", "In words"),
    unknown = ProtoField.string("fauxboard.unknown", "Unknown field"),
    checksum = ProtoField.uint8("fauxboard.checksum", "Checksum", base.DEC),
    status = ProtoField.string("fauxboard.checksum.status", "Checksum status"),
}
local wrong_checksum = ProtoExpert.new("fauxboard.checksum.wrong", "Wrong checksum", expert.group.CHECKSUM,
    expert.severity.ERROR)
local unknown_code = ProtoExpert.new("fauxboard.code.unknown", "Unknown code", expert.group.UNDECODED,
    expert.severity.WARN)
local unknown_field = ProtoExpert.new("fauxboard.field.unknown", "Unknown field", expert.group.UNDECODED,
    expert.severity.WARN)

local function slug(text)
    return (text:lower():gsub("[^%w]+", "_"):gsub("^_+", ""):gsub("_+$", ""))
end

-- The names of a code's fields in filters. A field without letters in its key, or with those of another key ("B:",
-- "B@:"), goes by its name; where the code has several of that name, each has that of the field before it ahead:
-- "bed_target".
local function name_fields(code)
    local count, key_of = {}, {}
    for _, field in ipairs(code.fields) do
        field.last = slug(field.key)
        field.by_key = field.last ~= "" and (key_of[field.last] or field.key) == field.key
        if field.by_key then
            key_of[field.last] = field.key
        else
            field.last = slug(field.name)
            count[field.last] = (count[field.last] or 0) + 1
        end
    end
    local taken, before = {}, ""
    for _, field in ipairs(code.fields) do
        if field.by_key or count[field.last] == 1 then
            before = slug(field.name)
        elseif before ~= "" then
            field.last = before .. "_" .. field.last
        end
        if field.last == "" then field.last = "value" end
        taken[field.last] = true
    end
    for _, field in ipairs(code.fields) do
        local label = slug(field.name)
        if label ~= "" and not taken[label] then
            taken[label] = true
            field.label = label
        end
    end
end

local all = {}
local is_text = {}

-- "fauxboard.board.l2.b"
local function filter_name(who, code, last, field)
    local name = slug(code.code)
    if name == "" then name = slug(code.title) end  -- a line that begins with "//"
    local filter = "fauxboard." .. who .. "." .. name .. "." .. last
    local textual = field.kind == "text" or field.kind == "word"
    is_text[filter] = is_text[filter] or textual
    all[filter] = field.name ~= "" and field.name or field.key
    return filter
end

for who, list in pairs(codes) do
    for _, code in ipairs(list) do
        if code.words then
            table.insert(by_words[who], code)
        else
            by_code[who][code.code] = code
        end
        name_fields(code)
        for _, field in ipairs(code.fields) do
            field.filters = {}
            for _, speaker in ipairs(who == "board" and { "board" } or { "screen", "host" }) do
                field.filters[speaker] = {
                    filter_name(speaker, code, field.last, field),
                    field.label and filter_name(speaker, code, field.label, field),
                }
            end
        end
    end
end
for filter, name in pairs(all) do
    local make = is_text[filter] and ProtoField.string or ProtoField.double
    fields[filter] = make(filter, name)
end

proto.experts = { wrong_checksum, unknown_code, unknown_field }
local declared = {}
for _, field in pairs(general) do table.insert(declared, field) end
for _, field in pairs(fields) do table.insert(declared, field) end
proto.fields = declared

-- ---- the frame ----

-- Wireshark's versions come with different Luas.
local bxor = bit and bit.bxor or bit32 and bit32.bxor or load("return function(a, b) return a ~ b end")()

local function xor_of(text)
    local sum = 0
    for i = 1, #text do sum = bxor(sum, text:byte(i)) end
    return sum
end

-- "N-0 " and the like at `at`; where it ends, or nil.
local function prefix_end(text, at)
    local _, number = text:find("^N[+-]?%d+", at)
    if not number then return nil end
    local next = text:sub(number + 1, number + 1)
    if next ~= "" and not next:find("[ \t%u*]") then return nil end
    local _, blanks = text:find("^[ \t]*", number + 1)
    return blanks + 1
end

-- The line without its frame: where the body starts and ends (inclusive), and what is to be said of the checksum.
local function unframe(line)
    local from = #line:match("^[ \t]*") + 1
    local first = from
    local prefixed = false
    local after = prefix_end(line, from)
    while after do
        prefixed = true
        from = after
        after = prefix_end(line, from)
    end
    local frame = { from = from, to = #line, status = prefixed and "missing" or "none" }
    local star = line:match("^.*()%*")
    local rest = line:sub(from)
    local exempt = not prefixed and (rest:find("^M23[ \t]") or rest:find("^log[ \t]") or rest == "log")
    if not star or star < from or exempt then return frame end
    local tail = line:sub(star + 1):match("^(.-)[ \t]*$")
    if tail == "" and prefixed then
        frame.to = star - 1
    elseif tail:find("^%d%d?%d?$") and tonumber(tail) <= 255 then
        frame.to = star - 1
        frame.star = star
        frame.given = tonumber(tail)
        frame.expected = xor_of(line:sub(first, star - 1))
        frame.status = frame.given == frame.expected and "right" or "wrong"
    end
    return frame
end

-- ---- the fields ----

local function number_length(text)
    local number = text:match("^[+-]?%d+%.?%d*") or text:match("^[+-]?%.%d+")
    if not number then return 0 end
    local exponent = text:sub(#number + 1):match("^e[+-]?%d+") or ""
    return #number + #exponent
end

local Reader = {}
Reader.__index = Reader

function Reader.new(text, infos)
    return setmetatable({ text = text, infos = infos, used = {}, at = 1, next = 1 }, Reader)
end

function Reader:next_takes_rest()
    local info = self.infos[self.next]
    return info and info.key == "" and info.kind == "text" and not self.used[info]
end

function Reader:longer_key_at(at, key)
    for _, info in ipairs(self.infos) do
        if #info.key > #key and self.text:sub(at, at + #info.key - 1) == info.key then return true end
    end
    return false
end

function Reader:starts_here(index, at)
    local info = self.infos[index]
    if self.used[info] or (info.when and info.when ~= self.selector) then return false end
    if info.key == "" then
        return index == self.next and info.kind ~= "text" and number_length(self.text:sub(at)) ~= 0
    end
    return self.text:sub(at, at + #info.key - 1) == info.key and not self:longer_key_at(at, info.key)
end

function Reader:any_starts_at(at, from)
    for index = from, #self.infos do
        if self.infos[index].key ~= "" and self:starts_here(index, at) then return true end
    end
    return false
end

-- Later fields are tried first, so that L2's four pairs of slashes find their heater.
function Reader:find_info()
    if self:next_takes_rest() then return self.next end
    for i = 0, #self.infos - 1 do
        local index = (self.next - 1 + i) % #self.infos + 1
        if self:starts_here(index, self.at) then return index end
    end
    return nil
end

function Reader:run_to_blank()
    return #self.text:match("^[^ \t]*", self.at)
end

function Reader:text_length(info)
    if info.closing then
        local mark = self.text:find(info.closing, self.at, true)
        if mark then return mark - self.at end
    end
    if info.key == "" then return #self.text - self.at + 1 end
    for i = self.at, #self.text do
        if self.text:find("^[ \t]", i) and self:any_starts_at(i + 1, self.next) then
            return #self.text:sub(self.at, i - 1):match("^(.-)[ \t]*$")
        end
    end
    return #self.text - self.at + 1
end

function Reader:number_length()
    local length = number_length(self.text:sub(self.at))
    local after = self.at + length
    local next = self.text:sub(after, after)
    if next == "" or next:find("[ \t]") or self:any_starts_at(after, 1) or (length ~= 0 and next:find("%u")) then
        return length
    end
    return self:run_to_blank()
end

-- A field of no known name: its letter, or all up to its colon, and what follows.
function Reader:read_unknown()
    local token = self.text:sub(self.at, self.at + self:run_to_blank() - 1)
    local colon = token:find(":", 1, true)
    local key = colon or (token:find("^%u") and 1) or 0
    local value = token:sub(key + 1)
    local number = number_length(value)
    if key == 1 and not colon and number ~= 0 and value:find("^%u", number + 1) then
        value = value:sub(1, number)
    end
    local field = { at = self.at, length = math.max(1, key + #value), key = token:sub(1, key), text = value }
    self.at = self.at + field.length
    return field
end

function Reader:read_field()
    local index = self:find_info()
    if not index then return self:read_unknown() end
    local info = self.infos[index]
    local field = { info = info, at = self.at, key = info.key }
    self.used[info] = true
    self.next = index + 1
    self.at = self.at + #info.key
    local length = info.kind == "text" and self:text_length(info) or self:number_length()
    field.text = self.text:sub(self.at, self.at + length - 1)
    self.at = self.at + length
    field.number = info.kind ~= "text" and field.text:find("^[+-]?[%d.]+$") and tonumber(field.text) or nil
    field.length = self.at - field.at
    if info.closing and self.text:sub(self.at, self.at) == info.closing then self.at = self.at + 1 end
    if index == 1 then self.selector = field.number end
    return field
end

function Reader:read()
    local found = {}
    while self.at <= #self.text do
        local blanks = #self.text:match("^[ \t]*", self.at)
        local rest = self:next_takes_rest()
        if self.at + blanks > #self.text and not rest then break end
        self.at = self.at + ((rest and blanks ~= 0) and 1 or blanks)
        table.insert(found, self:read_field())
    end
    return found
end

-- ---- the code ----

-- The entry of a body, how it is called, and how many bytes of it are the code.
local function find_code(who, body)
    local best
    for _, code in ipairs(by_words[who]) do
        local after = body:sub(#code.code + 1, #code.code + 1)
        if body:sub(1, #code.code) == code.code and not (code.code:find("%a$") and after:find("%a"))
            and (not best or #code.code > #best.code) then
            best = code
        end
    end
    if best then return best, best.code, #best.code end
    local letter, digits = body:match("^([GMTL])(%d+)")
    if letter and tonumber(digits) <= 65535 then
        local name = letter .. string.format("%d", tonumber(digits))
        return by_code[who][name], name, 1 + #digits
    end
    local word = body:match("^[^ \t]*")
    return nil, word, #word
end

-- ---- words ----

local function printable(text)
    return (text:gsub("[^\32-\126]", function(c) return string.format("\\x%02x", c:byte()) end))
end

local function mixing_words(number)
    if number < 0 or number > 0xFFFFFF then return nil end
    local words, sum, left = {}, 0, number
    for extruder = 0, 2 do
        local percent = left % 256
        left = (left - percent) / 256
        sum = sum + percent
        if percent ~= 0 then table.insert(words, string.format("E%d %d %%", extruder, percent)) end
    end
    return sum == 100 and table.concat(words, " ") or nil
end

local function value_words(field)
    local info = field.info
    local number = field.number
    if info.kind == "text" then return '"' .. printable(field.text:match("^[ \t]*(.*)$")) .. '"' end
    if number and info.values and info.values[number] then return info.values[number] end
    if number and info.form == "mixing" then
        local words = mixing_words(number)
        if words then return words end
    end
    if number and info.unit then return field.text .. " " .. info.unit end
    return printable(field.text)
end

local function field_words(field)
    if not field.info then return 'unknown "' .. printable(field.key .. field.text) .. '"' end
    if field.info.kind == "word" then return field.info.name end
    local value = value_words(field)
    if field.info.name == "" then return value end
    return field.info.name .. ": " .. value
end

-- ---- the tree ----

local function add_value(tree, filter, range, field)
    if is_text[filter] then return tree:add(fields[filter], range, printable(field.text)) end
    if field.number then return tree:add(fields[filter], range, field.number) end
    return tree:add(range)
end

local function add_field(tree, speaker, field, bytes)
    local range = bytes(field.at - 1, field.length)
    if not field.info then
        local item = tree:add(general.unknown, range, printable(field.key .. field.text))
        item:add_proto_expert_info(unknown_field)
        return
    end
    local filters = field.info.filters[speaker]
    local item = add_value(tree, filters[1], range, field)
    item:set_text(field_words(field))
    if field.info.meaning then item:append_text(" [" .. field.info.meaning .. "]") end
    if filters[2] and (field.number or is_text[filters[2]]) then
        add_value(tree, filters[2], range, field):set_hidden(true)
    end
end

local function add_checksum(tree, frame, bytes)
    if frame.given then
        local range = bytes(frame.star)
        local item = tree:add(general.checksum, range, frame.given)
        item:append_text(frame.status == "right" and " [right]" or " [wrong, right would be " .. frame.expected .. "]")
        if frame.status == "wrong" then item:add_proto_expert_info(wrong_checksum) end
    end
    tree:add(general.status, frame.status):set_generated()
end

-- Whether only the line of a board and its touch screen carries it.
local function is_of_a_screen(line, code)
    if line:find("^[ \t]*N") then return line:find("^[ \t]*N%-0[^%d]") ~= nil end
    return code ~= nil and (code.code == "log" or code.code:find("^L%d") ~= nil)
end

-- One line, `bytes` without its end. Returns it in words.
local function dissect_line(who, bytes, tree)
    local line = bytes:raw()
    local frame = unframe(line)
    local body = line:sub(frame.from, frame.to)
    local code, name, length = find_code(who, body)
    if is_of_a_screen(line, code) then peer = "screen" end
    local speaker = who == "board" and who or peer
    tree:add(general.line, bytes, printable(line))
    local words = code and code.title or 'unknown "' .. printable(body) .. '"'
    local code_item
    if length > 0 then code_item = tree:add(general.code, bytes(frame.from - 1, length), printable(name)) end
    if code then
        tree:add(general.title, code.title):set_generated()
        tree:add(general.meaning, code.meaning):set_generated()
        if code.answer then tree:add(general.answer, code.answer):set_generated() end
    elseif code_item then
        code_item:add_proto_expert_info(unknown_code)
    end
    local start = frame.from + length
    local found = Reader.new(line:sub(start, frame.to), code and code.fields or {}):read()
    local said = {}
    if #found > 0 then
        local body_bytes = bytes(start - 1, frame.to - start + 1)
        for _, field in ipairs(found) do
            add_field(tree, speaker, field, body_bytes)
            table.insert(said, field_words(field))
        end
    end
    if code and #said > 0 then words = words .. ": " .. table.concat(said, ", ") end
    add_checksum(tree, frame, bytes)
    if frame.status == "wrong" then words = words .. " [wrong checksum]" end
    tree:add(general.words, words):set_generated()
    return words
end

local serial = DissectorTable.get("wtap_encap"):get_dissector(wtap.RTAC_SERIAL)

function proto.dissector(buffer, pinfo, root)
    serial:call(buffer, pinfo, root)
    local who = buffer:len() > header_bytes and events[buffer(8, 1):uint()]
    if not who then return buffer:len() end
    local text = buffer:raw(header_bytes)
    local nuls = #text:match("^%z*")  -- an A30 screen sends one behind its message at power-up
    local ends = #text:match("[\r\n%z]*$")
    local length = #text - nuls - ends
    pinfo.cols.protocol = "fauxboard"
    local tree = root:add(proto, buffer(header_bytes))
    local words = "(empty line)"
    if length > 0 then
        words = dissect_line(who, buffer(header_bytes + nuls, length), tree)
        if ends == 0 then words = words .. " [line not ended]" end
    end
    local from, to = who == "board" and who or peer, who == "board" and peer or "board"
    pinfo.cols.src = from
    pinfo.cols.dst = to
    tree:add(general.direction, from .. " → " .. to):set_generated()
    tree:append_text(", " .. from .. " → " .. to)
    pinfo.cols.info = words
    return buffer:len()
end

DissectorTable.get("wtap_encap"):add(wtap.RTAC_SERIAL, proto)

-- ---- the wires to a UV panel ----

local spi = Proto("fauxboard_spi", "Wires to a UV panel")
local spi_head_bytes = 16
local spi_marks = { O = "out", I = "in", P = "pin", R = "reset" }
local spi_chips = { [0] = "fpga", [1] = "left", [2] = "right" }
local spi_registers = {
    [0x10] = "sleep in", [0x11] = "sleep out", [0x28] = "display off", [0x29] = "display on",
    [0xB0] = "read the id", [0xB7] = "configuration",
}
local spi_fields = {
    kind = ProtoField.string("fauxboard_spi.kind", "Kind"),
    chip = ProtoField.string("fauxboard_spi.chip", "Chip select"),
    level = ProtoField.uint8("fauxboard_spi.level", "Level"),
    number = ProtoField.uint32("fauxboard_spi.number", "Transfer"),
    what = ProtoField.string("fauxboard_spi.what", "What"),
    words = ProtoField.string("fauxboard_spi.words", "In words"),
    bank = ProtoField.uint8("fauxboard_spi.bank", "Bank"),
    line = ProtoField.uint16("fauxboard_spi.line", "Line"),
    lit = ProtoField.uint16("fauxboard_spi.lit", "Lit pixels"),
    checksum = ProtoField.uint16("fauxboard_spi.checksum", "Checksum", base.HEX),
    scan = ProtoField.bool("fauxboard_spi.scan", "Scan"),
    sdram = ProtoField.bool("fauxboard_spi.sdram", "SDRAM read"),
    wrong = ProtoField.bool("fauxboard_spi.wrong", "Wrong"),
    data = ProtoField.bytes("fauxboard_spi.data", "Data"),
}
spi.fields = spi_fields
local spi_wrong = ProtoExpert.new("fauxboard_spi.expert", "Wrong", expert.group.CHECKSUM, expert.severity.WARN)
spi.experts = { spi_wrong }

-- One row for each byte at the head of the checksum: polynomial 0x1021, highest bit first.
local crc_rows = {}
for byte = 0, 255 do
    local sum = byte * 256
    for _ = 1, 8 do
        sum = sum >= 0x8000 and bxor(sum * 2 - 0x10000, 0x1021) or sum * 2
    end
    crc_rows[byte] = sum
end

local function crc_of(text)
    local sum = 0
    for i = 1, #text do
        local high = math.floor(sum / 256)
        sum = bxor((sum - high * 256) * 256, crc_rows[bxor(high, text:byte(i))])
    end
    return sum
end

local lit_of_byte = {}
for byte = 0, 255 do
    local count, left = 0, byte
    while left > 0 do
        count = count + left % 2
        left = math.floor(left / 2)
    end
    lit_of_byte[byte] = count
end

-- The pixels of a line: two halves of 90 bytes, 6 dead ones behind each.
local function lit_of(text)
    local count = 0
    for i = 1, 192 do
        local place = (i - 1) % 96
        if place < 90 then count = count + lit_of_byte[text:byte(i)] end
    end
    return count
end

local function command_words(byte)
    return string.format("bank %d, scan %s, SDRAM %s", math.floor(byte / 16) % 4, byte >= 0x80 and "on" or "off",
        math.floor(byte / 0x40) % 2 == 1 and "on" or "off")
end

local function add_command(tree, range)
    local byte = range:uint()
    tree:add(spi_fields.bank, range, math.floor(byte / 16) % 4)
    tree:add(spi_fields.scan, range, byte >= 0x80)
    tree:add(spi_fields.sdram, range, math.floor(byte / 0x40) % 2 == 1)
    return command_words(byte)
end

local function dissect_packet(data, tree)
    local text = data:raw()
    local line = text:byte(1) % 16 * 256 + text:byte(2)
    local bank = math.floor(text:byte(1) / 16) % 4
    local given, right = data(194, 2):uint(), crc_of(text:sub(1, 194))
    local lit = lit_of(text:sub(3, 194))
    tree:add(spi_fields.bank, data(0, 1), bank)
    tree:add(spi_fields.line, data(0, 2), line)
    tree:add(spi_fields.lit, data(2, 192), lit)
    tree:add(spi_fields.checksum, data(194, 2))
    local words = string.format("bank %d, line %d: %d lit, checksum %04X %s", bank, line, lit, given,
        given == right and "good" or string.format("wrong, %04X would be right", right))
    if line >= 2560 then words = words .. "; there is no such line" end
    return "line", words, given ~= right or line >= 2560
end

local function nothing(length)
    return "unknown", length .. " bytes that mean nothing", true
end

local function dissect_fpga(data, length, tree)
    local first = length > 0 and data(0, 1):uint() or -1
    if length == 196 and first >= 0x40 and first < 0x80 then return dissect_packet(data, tree) end
    if length ~= 3 then return nothing(length) end
    if first == 0 then
        return "command", string.format("%02X: ", data(2, 1):uint()) .. add_command(tree, data(2, 1)), false
    end
    if first == 0x80 then return "read back", "which command?", false end
    return nothing(length)
end

local function dissect_controller(data, length)
    if length < 3 then return nothing(length) end
    local known = spi_registers[data(0, 1):uint()]
    return "register", string.format("%02X = %04X", data(0, 1):uint(), data(1, 2):le_uint()) ..
        (known and ": " .. known or ""), not known
end

local function dissect_answer(chip, data, length, tree)
    if chip ~= 0 then
        return "register", "id " .. (length < 4 and "?" or string.format("%04X", data(2, 2):uint())), false
    end
    if length ~= 3 then return nothing(length) end
    local byte = data(2, 1):uint()
    return "read back",
        string.format("%02X: ", byte) .. add_command(tree, data(2, 1)) .. ", version " .. byte % 16, false
end

local function dissect_record(kind, chip, level, data, length, tree)
    if kind == "P" then return "pin", level == 1 and "checksum good" or "checksum bad", level ~= 1 end
    if kind == "R" then return "reset", level == 1 and "released" or "pulled low", false end
    if kind == "I" then return dissect_answer(chip, data, length, tree) end
    if chip == 0 then return dissect_fpga(data, length, tree) end
    return dissect_controller(data, length)
end

function spi.dissector(buffer, pinfo, root)
    if buffer:len() < spi_head_bytes or buffer(0, 1):uint() ~= 0xA5 then return 0 end
    local kind = buffer(1, 1):string()
    local chip = buffer(2, 1):uint()
    local length = buffer:len() - spi_head_bytes
    if not spi_marks[kind] or not spi_chips[chip] then return 0 end
    local tree = root:add(spi, buffer())
    tree:add(spi_fields.kind, buffer(1, 1), spi_marks[kind])
    tree:add(spi_fields.chip, buffer(2, 1), spi_chips[chip])
    tree:add(spi_fields.level, buffer(3, 1))
    tree:add(spi_fields.number, buffer(6, 4))
    local data = length > 0 and buffer(spi_head_bytes) or nil
    if data then tree:add(spi_fields.data, data) end
    local what, words, wrong = dissect_record(kind, chip, buffer(3, 1):uint(), data, length, tree)
    tree:add(spi_fields.what, what):set_generated()
    tree:add(spi_fields.words, words):set_generated()
    tree:add(spi_fields.wrong, wrong):set_generated()
    if wrong then tree:add_proto_expert_info(spi_wrong, words) end
    local from_board = kind == "O" or kind == "R"
    pinfo.cols.protocol = "fauxboard_spi"
    pinfo.cols.src = from_board and "board" or spi_chips[chip]
    pinfo.cols.dst = from_board and spi_chips[chip] or "board"
    pinfo.cols.info = what .. ": " .. words
    return buffer:len()
end

DissectorTable.get("wtap_encap"):add(wtap.USER5, spi)
