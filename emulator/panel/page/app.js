// Which view is open, and the frame around it.

import {Board} from './board.js';
import {h, refill, say, show, time_text} from './dom.js';
import * as overview from './overview.js';
import * as screen from './screen.js';
import * as machine from './machine.js';
import * as curves from './curves.js';
import * as print from './print.js';
import * as talk from './talk.js';
import * as faults from './faults.js';
import * as scenario from './scenario.js';
import * as shelf from './shelf.js';

const views = [['overview', overview], ['screen', screen], ['curves', curves], ['print', print], ['talk', talk],
               ['machine', machine], ['faults', faults], ['scenario', scenario]];
const main = document.getElementById('main'), tabs = document.getElementById('tabs');
const title = document.getElementById('title'), clock = document.getElementById('clock');
const line = document.getElementById('line'), gone = document.getElementById('gone');

let board = null, unmount = null, boards = [];

// --- theme ---

const themes = ['', 'light', 'dark'];
function set_theme(name) {
    document.documentElement.dataset.theme = name;
    try { localStorage.setItem('theme', name); } catch (error) { /* a browser that keeps nothing */ }
}
try { set_theme(localStorage.getItem('theme') || ''); } catch (error) { set_theme(''); }
document.getElementById('theme').addEventListener('click', () => {
    const now = document.documentElement.dataset.theme;
    set_theme(themes[(themes.indexOf(now) + 1) % themes.length]);
    window.dispatchEvent(new Event('themechange'));
});

// --- where we are: #/BOARD/VIEW, #/ is the shelf ---

function place() {
    const parts = location.hash.replace(/^#\/?/, '').split('/');
    const number = parts[0] === '' ? null : Number(parts[0]);
    if (number === null || !Number.isInteger(number) || number < 0 || number >= boards.length)
        return boards.length > 1 ? {board: null, view: null} : {board: 0, view: 'overview'};
    return {board: number, view: views.some(([name]) => name === parts[1]) ? parts[1] : 'overview'};
}

function close_view() {
    if (unmount) unmount();
    unmount = null;
    main.replaceChildren();
}

function open_view() {
    close_view();
    const at = place();
    draw_tabs(at);
    if (at.board === null) {
        if (board) board.close();
        board = null;
        say(title, boards.length + ' boards');
        document.title = 'fauxboard: ' + boards.length + ' boards';
        say(clock, '');
        show(line, false);
        show(gone, false);
        main.className = 'shelf';
        unmount = shelf.mount(main, boards);
        return;
    }
    if (!board || board.number !== at.board) {
        if (board) board.close();
        say(title, boards[at.board].title || boards[at.board].profile);
        board = follow(new Board(at.board));
        window.board = board;  // for the browser's console, and tests
        return;  // the view opens when it has begun
    }
    if (!board.words) return;
    main.className = at.view;
    unmount = views.find(([name]) => name === at.view)[1].mount(main, board);
}

function draw_tabs(at) {
    const shelf_tab = boards.length > 1 ? h('a', {href: '#/', 'aria-current': at.board === null ? 'page' : null}, 'Shelf') : null;
    refill(tabs, shelf_tab, at.board === null ? null : views.map(([name, view]) =>
        h('a', {href: '#/' + at.board + '/' + name, 'aria-current': name === at.view ? 'page' : null}, view.title)));
}

function follow(made) {
    made.on('begin', () => {
        show(gone, false);
        document.body.classList.remove('lost');
        say(title, (boards.length > 1 ? boards[made.number].name + ' · ' : '') + (made.status.title || made.status.profile));
        document.title = (made.status.title || made.status.profile) + ' · fauxboard';
        draw_line();
        open_view();
    });
    made.on('gone', () => {
        say(gone, 'The board is gone: its run has ended, or this computer cannot reach it. Trying again…');
        show(gone, true);
        document.body.classList.add('lost');
    });
    made.on('link', draw_line);
    made.on('state', () => say(clock, time_text(made.t)));
    return made;
}

const line_words = {up: 'line in use', waiting: 'nobody on the line', opening: 'line closed'};
function draw_line() {
    if (!board) return;
    const state = board.link.state || '';
    say(line, line_words[state] || state);
    line.className = 'badge ' + (state === 'up' ? 'good' : 'idle');
    line.title = [board.link.kind, board.link.path, board.link.why].filter(Boolean).join(' · ');
    show(line, board.link.kind !== 'none');  // a board without a line
}

// --- keys: a digit opens the view of that place ---

document.addEventListener('keydown', event => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target.closest('input, select, textarea')) return;
    const at = place();
    if (at.board !== null && event.key >= '1' && event.key <= String(views.length))
        location.hash = '#/' + at.board + '/' + views[Number(event.key) - 1][0];
});

window.addEventListener('hashchange', open_view);

async function begin() {
    try {
        boards = await (await fetch('boards')).json();
        open_view();
    } catch (error) {
        say(gone, 'The board is gone: its run has ended, or this computer cannot reach it. Trying again…');
        show(gone, true);
        setTimeout(begin, 1000);
    }
}
begin();
