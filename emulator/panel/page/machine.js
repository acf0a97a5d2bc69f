// Every field and action of the board, from its own tables.

import {Refused} from './board.js';
import {h, say, show, unit_text, value_text} from './dom.js';

export const title = 'Machine';

const group_of = path => path.includes('.') ? path.slice(0, path.indexOf('.')) : path;

export function mount(root, board) {
    const filter = h('input', {type: 'search', placeholder: 'Filter: heaters, target, mm…', 'aria-label': 'Filter fields and actions',
                               oninput: sift});
    const groups = h('div', {class: 'groups'});
    root.append(h('div', {class: 'tools'}, filter), groups);

    const rows = new Map();   // path: row
    const cards = new Map();  // group: {card, body}
    const items = [];         // {element, text, card}

    function card_of(group) {
        if (!cards.has(group)) {
            const body = h('div', {class: 'body'});
            const card = h('section', {class: 'card'}, h('h2', null, group), body);
            cards.set(group, {card, body});
            groups.append(card);
        }
        return cards.get(group);
    }

    function add(group, element, text) {
        const {card, body} = card_of(group);
        body.append(element);
        items.push({element, text: text.toLowerCase(), card});
    }

    for (const field of board.fields.values()) {
        const row = field_row(board, field);
        rows.set(field.path, row);
        add(group_of(field.path), row.element, field.path + ' ' + (field.unit || '') + ' ' + (field.help || ''));
    }
    for (const action of board.words.actions)
        add(group_of(action.name), action_form(board, action), action.name + ' ' + (action.phrase || '') + ' ' + action.help);

    function sift() {
        const words = filter.value.toLowerCase().split(/\s+/).filter(Boolean);
        const seen = new Set();
        for (const item of items) {
            const fits = words.every(word => item.text.includes(word)) && !item.element.classList.contains('absent');
            show(item.element, fits);
            if (fits) seen.add(item.card);
        }
        for (const {card} of cards.values()) show(card, seen.has(card));
    }

    function update(fields) {
        for (const [path, value] of Object.entries(fields)) rows.get(path)?.update(value);
    }
    update(board.state);
    sift();
    return board.on('state', message => update(message.fields));
}

function field_row(board, field) {
    const name = field.path.slice(group_of(field.path).length + 1) || field.path;
    const value = h('output', {class: 'value'});
    const fault = h('p', {class: 'error', role: 'alert', hidden: true});
    const settable = field.settable !== false;
    const control = settable ? setter(board, field, fault) : null;
    const element = h('div', {class: 'field absent', 'data-path': field.path},
        h('div', {class: 'name'}, h('code', null, name), h('small', null, field.help || '')), value, control && control.element, fault);
    return {element, update(now) {
        const absent = now === null;
        if (element.classList.contains('absent') !== absent) {
            element.classList.toggle('absent', absent);
            show(element, !absent);
        }
        say(value, value_text(field.type === 'boolean' && now !== null ? Boolean(now) : now, field.unit));
        if (control) control.update(now);
    }};
}

function setter(board, field, fault) {
    async function set(value) {
        show(fault, false);
        try {
            const answer = await board.op('set', {fields: {[field.path]: value}});
            return answer.fields[field.path];
        } catch (error) {
            if (!(error instanceof Refused)) throw error;
            say(fault, error.message);
            show(fault, true);
            return undefined;
        }
    }
    if (field.type === 'boolean') {
        const box = h('input', {type: 'checkbox', role: 'switch', 'aria-label': field.path, onchange: async () => {
            if (await set(box.checked) === undefined) box.checked = !box.checked;
        }});
        return {element: box, update: value => { box.checked = Boolean(value); }};
    }
    const text = field.type === 'text';
    const input = h('input', {type: text ? 'text' : 'number', step: 'any', 'aria-label': field.path, placeholder: 'set…',
                              title: text ? 'At most ' + field.max_bytes + ' bytes' : field.min + ' to ' + field.max + (field.unit ? ' ' + unit_text(field.unit) : '')});
    const form = h('form', {novalidate: true, onsubmit: async event => {
        event.preventDefault();
        if (input.value === '' && !text) return;
        if (await set(text ? input.value : Number(input.value)) !== undefined) input.value = '';
    }}, input);
    return {element: form, update: () => {}};
}

function action_form(board, action) {
    const fault = h('p', {class: 'error', role: 'alert', hidden: true});
    const done = h('span', {class: 'done', 'aria-live': 'polite'});
    const inputs = action.arguments.map(argument => {
        const label = argument.name + (argument.required ? '' : ' (if wanted)');
        if (argument.type === 'boolean')
            return {argument, input: h('select', {'aria-label': label}, argument.required ? null : h('option', {value: ''}, '–'),
                                       h('option', {value: 'true'}, 'yes'), h('option', {value: 'false'}, 'no'))};
        return {argument, input: h('input', {type: argument.type === 'number' ? 'number' : 'text', step: 'any', 'aria-label': label,
                                             placeholder: argument.name, title: argument.help})};
    });
    async function run(event) {
        event.preventDefault();
        const given = {};
        for (const {argument, input} of inputs) {
            if (input.value === '') continue;
            given[argument.name] = argument.type === 'number' ? Number(input.value) : argument.type === 'boolean' ? input.value === 'true' : input.value;
        }
        show(fault, false);
        try {
            const answer = await board.op('do', {do: {[action.name]: given}});
            say(done, (answer.notices || []).map(notice => notice.text).join(' ') || 'done');
            setTimeout(() => say(done, ''), 4000);
        } catch (error) {
            if (!(error instanceof Refused)) throw error;
            say(fault, error.message);
            show(fault, true);
        }
    }
    return h('form', {class: 'action', novalidate: true, onsubmit: run, 'data-action': action.name},
        h('div', {class: 'name'}, h('code', null, action.name), h('small', null, action.help)),
        inputs.map(({input}) => input), h('button', null, 'Do'), done, fault);
}
