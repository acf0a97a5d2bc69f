#include "tools/file_roles.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <filesystem>
#include <system_error>

#include "emulator/host/job_place_file.h"
#include "emulator/link/host_error.h"
#include "tools/panel_folder.h"
#include "tools/run_options.h"
#include "tools/spi_port.h"

namespace fauxboard::tools {

namespace fs = std::filesystem;

FileRoles::Place FileRoles::place_of(const std::string& path) {
    Place place;
    struct stat info {};
    if (::stat(path.c_str(), &info) == 0) {
        place.file = {info.st_dev, info.st_ino};
        place.device = S_ISCHR(info.st_mode);
    }
    std::error_code error;
    const fs::path whole = fs::absolute(path, error).lexically_normal();
    place.name = (fs::weakly_canonical(whole.parent_path(), error) / whole.filename()).string();
    place.target = fs::weakly_canonical(whole, error).string();
    return place;
}

bool FileRoles::clash(const Role& a, const Role& b) {
    const bool same = a.place.name == b.place.name || a.place.target == b.place.target ||
                      (a.place.file && a.place.file == b.place.file);
    const bool both_read = a.use == Use::read && b.use == Use::read;
    const bool for_many = a.place.device && a.use != Use::talk && b.use != Use::talk;
    return same && !both_read && !for_many;
}

void FileRoles::add(std::string what, const std::string& path, Use use) {
    if (path.empty()) {
        return;
    }
    Role role{std::move(what), path, place_of(path), use};
    for (const Role& other : roles_) {
        if (clash(role, other)) {
            throw link::HostError(fmt::format("{} ({}) and {} ({}) are the same. Give each one of its own.",
                                              other.what, other.path, role.what, path));
        }
    }
    roles_.push_back(std::move(role));
}

void FileRoles::reads(const std::string& what, const std::vector<std::string>& paths) {
    for (const std::string& path : paths) {
        reads(what, path);
    }
}

void FileRoles::add_log(const LogOptions& log) {
    if (!log.wanted()) {
        return;
    }
    writes("the log", log.file);
    for (unsigned age = 1; age < log.files; ++age) {
        writes("an older log", host::LogFile::path_of(log.file, age));
    }
}

void FileRoles::add_board(const RunOptions& options, const std::string& whose) {
    const auto own = [&](const char* what) { return what + whose; };
    reads(own("the SD card"), options.sd);
    reads(own("the U-disk"), options.udisk);
    talks(own("the line"), options.port == "auto" ? std::string() : options.port);
    talks(own("the USB port"), options.host.port);
    writes(own("the EEPROM"), options.eeprom);
    if (!options.eeprom.empty()) {
        writes(own("the place of a print"), host::JobPlaceFile::beside(options.eeprom));
    }
    writes(own("the folder of --panel"), options.panel);
    if (!options.panel.empty()) {
        writes(own("the list of --panel"), PanelFolder::list_in(options.panel));
    }
    writes(own("the wires of --spi"), SpiPort::file_of(options.spi));
    writes(own("the recording"), options.record);
    writes(own("the control channel"), options.control);
    writes(own("the link to the line"), options.pty_name);
    writes(own("the link to the USB port"), options.host.pty_name);
    writes(own("the report"), options.report);
    writes(own("the JUnit report"), options.junit);
}

}  // namespace fauxboard::tools
