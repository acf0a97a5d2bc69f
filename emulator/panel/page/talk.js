// What is said on every line, with its words, and what became of it.

import {Refused} from './board.js';
import {h, say, show} from './dom.js';

export const title = 'Talk';

const most_rows = 1000;
const board_ends = new Set(['board', 'usb', 'module']);

export function mount(root, board, {small = false} = {}) {
    const list = h('div', {class: 'talk', role: 'log', 'aria-live': 'off', tabindex: '0', 'aria-label': 'Talk'});
    const filter = h('input', {type: 'search', placeholder: 'Filter: L2, M104, lost…', 'aria-label': 'Filter the talk', oninput: sift});
    const marked = h('input', {type: 'checkbox', onchange: sift});
    const pause = h('button', {class: 'plain', 'aria-pressed': 'false', onclick: () => hold(!paused)}, 'Pause');
    const count = h('span', {class: 'quiet'});
    const limit = small ? 60 : most_rows;
    let paused = false, held = 0, rows = [];

    if (!small)
        root.append(h('div', {class: 'tools'}, filter, h('label', null, marked, ' only what is marked'), pause,
            h('button', {class: 'plain', onclick: clear}, 'Clear'), count), sender(board));
    root.append(list);

    function hold(now) {
        paused = now;
        held = 0;
        say(pause, now ? 'Go on' : 'Pause');
        pause.setAttribute('aria-pressed', String(now));
        say(count, '');
    }
    function clear() {
        rows = [];
        list.replaceChildren();
    }
    function fits(row) {
        return (!marked.checked || row.marks.length > 0) && (!filter.value || row.text.includes(filter.value.toLowerCase()));
    }
    function sift() {
        for (const row of rows) show(row.element, fits(row));
    }
    function add(row) {
        if (paused) {
            say(count, ++held + ' since');
            return;
        }
        row.marks = row.marks || [];
        row.body = h('div', {class: 'said'}, h('code', null, row.line), row.words && !row.words.startsWith('unknown "') ? h('small', null, row.words) : null);  // else it says the line again
        row.element = h('div', {class: 'row ' + row.side}, h('time', null, row.t.toFixed(3)), h('span', {class: 'who'}, row.who), row.body);
        row.text = (row.who + ' ' + row.line + ' ' + (row.words || '')).toLowerCase();
        for (const mark of row.marks) draw_mark(row, mark);
        const at_end = list.scrollHeight - list.scrollTop - list.clientHeight < 40;
        list.append(row.element);
        rows.push(row);
        while (rows.length > limit) rows.shift().element.remove();
        if (!small) show(row.element, fits(row));
        if (at_end) list.scrollTop = list.scrollHeight;
    }
    function draw_mark(row, mark) {
        row.text += ' ' + mark.text.toLowerCase();
        row.body.append(h('span', {class: 'mark ' + mark.kind}, mark.text));
    }
    /** What is said later of a line that stands here already. */
    function mark_last(line, from, mark) {
        for (let i = rows.length - 1; i >= 0 && i >= rows.length - 200; --i) {
            if (rows[i].line === line && (!from || rows[i].from === from) && !rows[i].marks.some(each => each.text === mark.text)) {
                rows[i].marks.push(mark);
                draw_mark(rows[i], mark);
                if (!small) show(rows[i].element, fits(rows[i]));
                return true;
            }
        }
        return false;
    }
    function take_line(message) {
        add({t: message.t, from: message.from, who: message.from, side: board_ends.has(message.from) ? 'ours' : 'theirs',
             line: message.line, words: message.words, marks: message.refused ? [{kind: 'bad', text: 'not taken: ' + message.refused}] : []});
    }
    const stops = [
        board.on('traffic', take_line),
        board.on('notices', take_notice),
        board.on('notice', take_notice),
        board.on('link', message => add({t: message.t, who: 'line', side: 'aside', line: message.why})),
        board.on('spoiled', message => {
            const mark = {kind: 'fault', text: 'fault ' + message.kind + (message.fault ? ' (' + message.fault + ')' : '')};
            if (!mark_last(message.line, message.from, mark))
                add({t: message.t, from: message.from, who: message.from, side: board_ends.has(message.from) ? 'ours' : 'theirs',
                     line: message.line, marks: [mark]});
        }),
        board.on('judged', message => mark_last(message.line, 'board', {kind: 'screen', text: 'screen: ' + message.verdict + ': ' + message.why})),
    ];
    function take_notice(message) {
        if (message.level !== 'debug') add({t: message.t, who: message.level, side: 'aside ' + message.level, line: message.text});
    }
    board.op('talk').then(answer => answer.lines.forEach(take_line), () => {});
    const topics = ['traffic', 'spoiled', 'judged'].map(topic => board.subscribe(topic, topic === 'traffic' ? {words: true} : {}));
    return () => {
        stops.forEach(stop => stop());
        topics.forEach(topic => topic.then(stop => stop()));
    };
}

const ways = [
    ['request', 'to the board, as a request of its screen or host', text => ['request', {line: text}]],
    ['line', 'from the board, put into a frame', text => ['send', {line: text}]],
    ['frame', 'from the board: a frame of the profile', text => ['send', {frame: text}]],
    ['raw', 'from the board, bytes as they are', text => ['send', {raw: text}]],
];

function sender(board) {
    const way = h('select', {'aria-label': 'What to send'}, ways.map(([name, help]) => h('option', {value: name}, help)));
    const frames = h('datalist', {id: 'frames'}, (board.words.frames || []).map(name => h('option', {value: name})));
    const text = h('input', {type: 'text', placeholder: 'M105', 'aria-label': 'Line', autocomplete: 'off', spellcheck: 'false'});
    const fault = h('p', {class: 'error', role: 'alert', hidden: true});
    way.addEventListener('change', () => way.value === 'frame' ? text.setAttribute('list', 'frames') : text.removeAttribute('list'));
    return h('form', {class: 'tools send', onsubmit: async event => {
        event.preventDefault();
        show(fault, false);
        try {
            await board.op(...ways.find(([name]) => name === way.value)[2](text.value));
            text.select();
        } catch (error) {
            if (!(error instanceof Refused)) throw error;
            say(fault, error.message);
            show(fault, true);
        }
    }}, way, text, h('button', null, 'Send'), frames, fault);
}
