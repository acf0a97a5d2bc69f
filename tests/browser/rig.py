"""A real fauxboard and a real browser, for panel_test.py."""

import json
import shutil
import subprocess
import sys
import time

SKIPPED = 77

try:
    from selenium import webdriver
    from selenium.common.exceptions import (ElementClickInterceptedException, NoSuchElementException,
                                            StaleElementReferenceException)
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    print('skipped: python3-selenium is not installed')
    sys.exit(SKIPPED)

BROWSER = shutil.which('chromium')
DRIVER = shutil.which('chromedriver')
if not BROWSER or not DRIVER:
    print('skipped: chromium and chromium-driver are not installed')
    sys.exit(SKIPPED)

PATIENCE_S = 60  # a limit, not a wait: the machine may be busy


class Failed(Exception):
    pass


class Program:
    """A subcommand of fauxboard that says "ready". Ended with the `with` block."""

    def __init__(self, program, *arguments, folder):
        self.process = subprocess.Popen([program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                        text=True, cwd=folder)
        line = self.process.stdout.readline()
        if not line.startswith('ready '):
            raise Failed(f'{arguments}: no ready line, but {line!r}')
        self.ready = json.loads(line[len('ready '):])

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        self.end()

    def end(self):
        if self.process.poll() is None:
            self.process.terminate()
            self.process.wait(timeout=PATIENCE_S)
        self.process.stdout.close()


class Page:
    """A page of the panel, as a person has it before them."""

    opened = set()  # addresses; the browser may still tell of one that a case before has left

    def __init__(self, driver):
        self.driver = driver

    def open(self, address, view=''):
        self.opened.add(address)
        self.driver.get('about:blank')
        self.driver.get(address + view)

    def go(self, view):
        self.driver.execute_script('location.hash = arguments[0]', '#/0/' + view)
        self.wait(lambda: self.find('main.' + view), 'the view ' + view)

    def find(self, css):
        try:
            return self.driver.find_element(By.CSS_SELECTOR, css)
        except NoSuchElementException:
            return None

    def all(self, css):
        return self.driver.find_elements(By.CSS_SELECTOR, css)

    def text(self, css):
        found = self.find(css)
        return found.text if found else ''

    def wait(self, true, what, patience_s=PATIENCE_S):
        end = time.monotonic() + patience_s
        while time.monotonic() < end:
            try:
                got = true()
                if got:
                    return got
            except StaleElementReferenceException:
                pass
            time.sleep(0.05)
        raise Failed(f'waited in vain for {what() if callable(what) else what}')

    def wait_text(self, css, part):
        return self.wait(lambda: part in self.text(css), lambda: f'"{part}" in {css}; there is: {self.text(css)!r}')

    def press(self, label):
        """A button of the touch screen."""
        def once():
            for key in self.all('.face button.key'):
                if key.text == label:
                    try:
                        key.click()
                    except ElementClickInterceptedException:
                        self.driver.execute_script('arguments[0].scrollIntoView({block: "center"})', key)
                        return False
                    return True
            return False
        self.wait(once, lambda: f'the button {label}; there are: {self.text(".face")!r}')

    def type_into(self, css, text):
        field = self.wait(lambda: self.find(css), css)
        field.clear()
        field.send_keys(text, Keys.ENTER)

    def state(self, path):
        return self.driver.execute_script('return window.board ? window.board.state[arguments[0]] : null', path)

    def picture(self, file):
        self.driver.save_screenshot(file)

    def first_paint_ms(self):
        return self.driver.execute_script(
            'return performance.getEntriesByName("first-contentful-paint").map(entry => entry.startTime)[0]')

    # --- what must not have happened ---

    def check_silence(self, ignoring=()):
        """No error in the console but for those that hold one of `ignoring`."""
        errors = [entry['message'] for entry in self.driver.get_log('browser') if entry['level'] == 'SEVERE']
        errors = [error for error in errors if not any(part in error for part in ignoring)]
        if errors:
            raise Failed('the browser complains: ' + '\n'.join(errors))

    def check_requests(self):
        """No request to anywhere else."""
        for entry in self.driver.get_log('performance'):
            message = json.loads(entry['message'])['message']
            if message['method'] == 'Network.requestWillBeSent':
                url = message['params']['request']['url']
                if not url.startswith((*self.opened, 'data:', 'blob:', 'about:', 'chrome')):
                    raise Failed('a request goes elsewhere: ' + url)


def make_driver(width=1280, height=860, dark=False):
    options = webdriver.ChromeOptions()
    options.binary_location = BROWSER
    for argument in ('--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--hide-scrollbars',
                     '--disable-background-networking', '--disable-component-update', '--disable-sync', '--no-first-run',
                     '--disable-default-apps', f'--window-size={width},{height}'):
        options.add_argument(argument)
    if dark:
        options.add_argument('--force-dark-mode')
        options.add_argument('--blink-settings=preferredColorScheme=0')
    options.set_capability('goog:loggingPrefs', {'browser': 'ALL', 'performance': 'ALL'})
    driver = webdriver.Chrome(service=Service(DRIVER), options=options)
    driver.set_script_timeout(PATIENCE_S)
    return driver
