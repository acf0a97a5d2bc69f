#!/usr/bin/env python3
"""The panel in a real browser: panel_test.py PROGRAM [CASE...]. Exit code 77: no browser is installed."""

import json
import os
import struct
import sys
import tempfile
import traceback

import rig
from rig import Failed, Page, Program

TOKEN = 'browser-test-of-the-panel'
PROGRAM = ''


def start(folder, *arguments, web='127.0.0.1:0', speed='1'):
    return Program(PROGRAM, 'run', '--pty', '--speed', speed, '--web', f'{web}/{TOKEN}', *arguments, folder=folder)


def small_print(folder):
    """Some forty lines: heats a little, draws three squares above each other."""
    lines = [';TYPE:test', 'G28', 'G90', 'M82', 'G92 E0', 'G1 F6000']
    e = 0
    for layer in range(3):
        lines += [f';LAYER:{layer}', f'G1 Z{0.2 * (layer + 1):.2f}', 'G1 X100 Y100']
        for x, y in ((140, 100), (140, 140), (100, 140), (100, 100)):
            e += 2
            lines.append(f'G1 X{x} Y{y} E{e}')
    os.makedirs(os.path.join(folder, 'card'), exist_ok=True)
    with open(os.path.join(folder, 'card', 'small.gcode'), 'w', encoding='ascii') as file:
        file.write('\n'.join(lines) + '\n')
    return os.path.join(folder, 'card')


def a30t(folder, page):
    """The screen, the heat, a fault and its mark, a wrong value, all by hand."""
    with start(folder, speed='10') as board:
        page.open(board.ready['web'])
        page.wait_text('.warning', 'no real printer')
        page.wait_text('.face .top', 'Main')
        page.wait(lambda: page.first_paint_ms() is not None, 'a first paint')
        paint = page.first_paint_ms()
        print(f'  first paint {paint:.0f} ms')
        page.go('screen')
        for label in ('Control', 'Filament', 'Hotend on'):
            page.press(label)
        page.wait_text('.sent', 'M104')
        page.wait(lambda: page.state('heaters.nozzle.target') == 200, 'the target of 200')
        page.go('curves')
        page.wait(lambda: page.find('.plot canvas'), 'a curve')
        first = page.wait(lambda: page.state('heaters.nozzle.true'), 'a temperature')
        page.wait(lambda: page.state('heaters.nozzle.true') > first + 5, 'the curve to rise')
        page.wait_text('.legend', 'nozzle target 200.0')

        page.go('faults')
        page.wait(lambda: page.find('[data-kind="garble"] input[role=switch]'), 'the switch').click()
        page.wait_text('.force', 'garble')
        page.go('talk')
        page.wait_text('.mark.fault', 'fault garble')
        page.go('faults')
        page.wait(lambda: page.find('.force h2 button') and page.find('.force h2 button').is_displayed(), 'Clear all')
        page.find('.force h2 button').click()
        page.wait_text('.force', 'Nothing is broken')

        page.go('machine')
        page.type_into('input[aria-label="heaters.nozzle.target"]', '99999')
        sentence = page.wait(lambda: page.text('[data-path="heaters.nozzle.target"] .error'), 'the refusal')
        if 'out of bounds' not in sentence or '99999' not in sentence:
            raise Failed('the refusal says nothing: ' + sentence)
        page.type_into('input[aria-label="heaters.nozzle.target"]', '180')
        page.wait(lambda: page.state('heaters.nozzle.target') == 180, 'the value to be set')


def print_to_end(folder, page):
    """Follows a print of a small file to its end: progress, layers, the way of the head."""
    with start(folder, '--sd', small_print(folder), speed='20') as board:
        page.open(board.ready['web'], '#/0/print')
        page.wait_text('main.print', 'Progress')
        page.driver.execute_async_script(
            'const done = arguments[0]; window.board.op("request", {line: "M23 small.gcode"})'
            '.then(() => window.board.op("request", {line: "M24"})).then(done, done)')
        page.wait(lambda: page.state('job.active'), 'the print to begin')
        page.wait(lambda: (page.state('job.progress') or 0) > 20, 'some progress')
        page.wait(lambda: page.find('.bed .way') and len(page.find('.bed .way').get_attribute('d') or '') > 20,
                  'the way of the head')
        page.wait(lambda: page.find('.bed .below') and page.find('.bed .below').get_attribute('d'), 'the layer below')
        page.wait(lambda: page.state('job.status') in (0, 4), 'the end of the print')


def restart(folder, page):
    """The board goes and comes back at its address: the page says so, and goes on."""
    with start(folder) as board:
        address = board.ready['web']
        page.open(address)
        page.wait_text('.face .top', 'Main')
    page.wait_text('#gone', 'The board is gone')
    with start(folder, web=address.split('/')[2]):
        page.wait(lambda: not page.find('#gone').is_displayed(), 'the page to be back')
        page.wait_text('.face .top', 'Main')


def markup(folder, page):
    """What a line, a file's name or a profile says is text, whatever it looks like."""
    evil = '<img src=x onerror="window.evil=1"><script>window.evil=1</script>'
    card = os.path.join(folder, 'evil')
    os.makedirs(card)
    for name in ('<b>x<script>evil=1<', '"onload=evil=1.gcode'):
        with open(os.path.join(card, name.replace('/', '') + '.gcode'), 'w', encoding='ascii') as file:
            file.write(f'; {evil}\nM117 {evil}\n')
    with open(os.path.join(folder, 'evil.json'), 'w', encoding='utf-8') as file:
        json.dump({'name': 'evil', 'title': evil, 'protocol': 'smartto', 'extends': 'geeetech-a30t',
                   'identity': {'device_name': '<svg onload=evil=1>'}, 'frames': {'L14.evil': 'L14 ' + evil}}, file)
    with start(folder, '--profile', './evil.json', '--sd', card) as board:
        page.open(board.ready['web'], '#/0/talk')
        page.wait_text('#title', '<img src=x')
        page.driver.execute_async_script(
            'const [frame, done] = arguments; window.board.op("send", {frame})'
            '.then(() => window.board.op("request", {line: "M20"})).then(done, done)', 'L14.evil')
        page.wait_text('.talk', '<script>')
        for view in ('screen', 'print', 'machine', 'faults', 'overview'):
            page.go(view)
        page.wait_text('main.overview', 'Talk')
        if page.driver.execute_script('return window.evil'):
            raise Failed('markup of the line has run')
        if page.all('main img[src=x], main script, #title img'):
            raise Failed('markup of the line has become part of the page')


def chitu(folder, page):
    """A resin board: its height as a curve, and the picture of the layer while it prints."""
    stick = os.path.join(folder, 'stick')
    os.makedirs(stick)
    write_cbddlp(os.path.join(stick, 'cube.cbddlp'))
    with start(folder, '--profile', 'elegoo-mars-pro', '--sd', stick, speed='10') as board:
        page.open(board.ready['web'], '#/0/print')
        page.wait_text('main.print', 'LED')
        page.driver.execute_async_script(
            'const done = arguments[0]; window.board.op("advance", {by: 10})'
            '.then(() => window.board.op("request", {line: "M6030 \'cube.cbddlp\'"})).then(done, done)')
        page.wait(lambda: page.find('canvas.layer') and page.find('canvas.layer').is_displayed(), 'the picture of the layer')
        page.wait(lambda: page.find('canvas.layer.lit'), 'the LED to shine')
        page.go('curves')
        page.wait_text('.legend', 'z ')
        page.wait(lambda: page.find('.plot[data-unit="mm"] canvas'), 'the curve of the height')


def own_screen(folder, page):
    """A board with a screen of its own: its pixels, with its controls to press, and no line to talk on."""
    with Program(PROGRAM, 'run', '--profile', 'mks-dlp', '--speed', '10', '--web', f'127.0.0.1:0/{TOKEN}', folder=folder) as board:
        page.open(board.ready['web'], '#/0/screen')
        page.wait(lambda: page.find('.face.pixels img') and page.find('.face.pixels img').size['width'] > 200, 'its pixels')
        page.wait(lambda: page.find('.spot[title="FILES"]'), 'its controls').click()
        page.wait(lambda: page.find('.spot[title*="ack"]') or page.find('.spot[title*="BACK"]'), 'the page of files')
        page.go('print')
        page.driver.execute_async_script(
            'const done = arguments[0]; window.board.op("do", {do: {"uvtest.image": {n: 3}}})'
            '.then(() => window.board.op("advance", {by: 10}))'
            '.then(() => window.board.op("do", {do: {"uvtest.display": {on: true}}}))'
            '.then(() => window.board.op("do", {do: {"uvtest.light": {on: true}}})).then(done, done)')
        page.wait(lambda: page.find('canvas.layer.lit'), 'what the panel lets through')
        white = page.driver.execute_script(
            'const layer = document.querySelector("canvas.layer");'
            'const bytes = layer.getContext("2d").getImageData(0, 0, layer.width, layer.height).data;'
            'return bytes.filter((value, i) => i % 4 === 0 && value === 255).length / (bytes.length / 4)')
        if not 0.1 < white < 0.9:
            raise Failed(f'six blocks are to be seen, and {white:.0%} of the picture is white')
        if page.find('#line').is_displayed():
            raise Failed('a board without a line has one: ' + page.text('#line'))


def no_screen(folder, page):
    """A board whose screen nobody knows: every view all the same."""
    with start(folder, '--profile', 'marlin') as board:
        page.open(board.ready['web'])
        page.wait_text('main.overview', 'No screen is known')
        page.wait_text('.talk', 'echo:SD card ok')
        for view in ('screen', 'curves', 'print', 'machine', 'faults', 'scenario', 'talk'):
            page.go(view)


def write_cbddlp(path, layers=4, width=1440, height=2560):
    """A cube in the form that ChiTu boards print, version 1: header, layer table, pictures of runs."""
    def runs():
        out = bytearray()
        def put(lit, count):
            while count > 0:
                part = min(count, 0x7D)
                out.append((0x80 if lit else 0) | part)
                count -= part
        for y in range(height):
            if 800 <= y < 1700:
                put(False, 400)
                put(True, 600)
                put(False, width - 1000)
            else:
                put(False, width)
        return bytes(out)
    picture = runs()
    table = 0x70
    data = table + 36 * layers
    head = struct.pack('<II', 0x12FD0019, 1) + struct.pack('<3f', 68.04, 120.96, 150.0) + struct.pack('<3I', 0, 0, 0)
    head += struct.pack('<4f', 0.05, 2.0, 4.0, 0.5) + struct.pack('<I', 1) + struct.pack('<2I', width, height)
    head += struct.pack('<I', 0) + struct.pack('<I', table) + struct.pack('<I', layers) + struct.pack('<I', 0)
    head += struct.pack('<I', 60) + struct.pack('<I', 1) + struct.pack('<2I', 0, 0) + struct.pack('<I', 1)
    head += struct.pack('<2H', 255, 255)
    head = head.ljust(0x70, b'\0')
    with open(path, 'wb') as file:
        file.write(head)
        for n in range(layers):
            file.write(struct.pack('<3f2I', 0.05 * (n + 1), 2.0, 0.5, data + n * len(picture), len(picture)).ljust(36, b'\0'))
        for n in range(layers):
            file.write(picture)


def fleet(folder, page):
    """Twenty boards on a shelf; one of them is opened, and breaks."""
    with open(os.path.join(folder, 'fleet.json'), 'w', encoding='ascii') as file:
        json.dump({'boards': [{'profile': 'geeetech-a30t', 'count': 14, 'name': 'shelf'},
                              {'profile': 'elegoo-mars-pro', 'count': 6, 'name': 'resin'}]}, file)
    with Program(PROGRAM, 'fleet', 'fleet.json', '--web', f'127.0.0.1:0/{TOKEN}', folder=folder) as boards:
        if len(boards.ready['boards']) != 20 or len({board['path'] for board in boards.ready['boards']}) != 20:
            raise Failed('twenty boards with a line each were asked for')
        page.open(boards.ready['web'])
        page.wait(lambda: len(page.all('.board')) == 20, 'twenty boards')
        page.wait_text('.board .words', '°C')
        page.all('.board')[2].click()
        page.wait_text('.face .top', 'Main')
        page.driver.execute_async_script(
            'const done = arguments[0]; window.board.op("faults.add", {spec: "jam"}).then(done, done)')
        page.driver.execute_script('location.hash = "#/"')
        page.wait_text('.board:nth-child(3) .badge.bad', '1 fault')


def paint(folder, page):
    """First paint on loopback, of a page that was never opened before."""
    with start(folder) as board:
        times = []
        for _ in range(5):
            page.driver.execute_cdp_cmd('Network.clearBrowserCache', {})
            page.open(board.ready['web'])
            page.wait_text('.face .top', 'Main')
            page.wait(lambda: page.first_paint_ms() is not None, 'a first paint')  # told a moment after it
            times.append(page.first_paint_ms())
        print('  first paint: ' + ', '.join(f'{each:.0f}' for each in times) + ' ms')


CASES = [a30t, print_to_end, restart, markup, chitu, own_screen, no_screen, fleet, paint]
#: What the browser itself writes when a board goes away, as it must in that case.
EXPECTED = {'restart': ('ERR_', 'Failed to load resource')}


def main(arguments):
    global PROGRAM
    PROGRAM = os.path.abspath(arguments[0])
    wanted = arguments[1:] or [case.__name__ for case in CASES]
    driver = rig.make_driver()
    failed = []
    try:
        for case in CASES:
            if case.__name__ not in wanted:
                continue
            page = Page(driver)
            print(f'{case.__name__}: {case.__doc__}', flush=True)
            try:
                with tempfile.TemporaryDirectory(prefix='fauxboard-browser-') as folder:
                    case(folder, page)
                page.check_silence(EXPECTED.get(case.__name__, ('ERR_CONNECTION_REFUSED', 'ERR_INCOMPLETE_CHUNKED')))
                page.check_requests()
            except Exception:  # noqa: BLE001 - each case is told, whatever went wrong
                traceback.print_exc()
                failed.append(case.__name__)
    finally:
        driver.quit()
    print(f'failed: {", ".join(failed)}' if failed else 'all passed')
    return 1 if failed else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1:]))
