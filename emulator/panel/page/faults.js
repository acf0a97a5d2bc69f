// What can be broken, as switches; what is in force, and how often it acted.

import {Refused} from './board.js';
import {h, refill, say, show, time_text} from './dom.js';

export const title = 'Faults';

export function mount(root, board) {
    const words = board.words.faults;
    const force = h('div', {class: 'body'});
    const fault = h('p', {class: 'error', role: 'alert', hidden: true});
    const clear = h('button', {class: 'plain', onclick: () => attempt('faults.clear', {})}, 'Clear all');
    root.append(h('section', {class: 'card force'}, h('h2', null, 'In force ', clear), fault, force));
    const cards = [
        ...kinds(words).map(([kind, common, printer]) => switch_card(kind, common, printer)),
    ];
    const line = h('div', {class: 'groups'}, cards.filter(card => !card.printer).map(card => card.element));
    const printer = h('div', {class: 'groups'}, cards.filter(card => card.printer).map(card => card.element));
    root.append(h('h2', {class: 'chapter'}, 'The line'), line, h('h2', {class: 'chapter'}, 'The printer'), printer);
    let timer = null, drawn = '', ended = false;

    async function attempt(op, parameters) {
        show(fault, false);
        try {
            return await board.op(op, parameters);
        } catch (error) {
            if (!(error instanceof Refused)) throw error;
            say(fault, error.message);
            show(fault, true);
            return null;
        } finally {
            look();
        }
    }

    function switch_card(kind, common, printer) {
        const inputs = [...kind.attributes, ...common].map(attribute => ({attribute, input: attribute_input(attribute)}));
        const box = h('input', {type: 'checkbox', role: 'switch', 'aria-label': kind.name, onchange: async () => {
            if (box.checked) {
                const spec = {kind: kind.name};
                for (const {attribute, input} of inputs) if (input.value !== '') spec[attribute.name] = typed(attribute, input.value);
                if (!await attempt('faults.add', {spec})) box.checked = false;
            } else {
                for (const id of card.ids) await attempt('faults.remove', {fault: id});
            }
        }});
        const card = {name: kind.name, printer, ids: [], box, element: h('section', {class: 'card fault', 'data-kind': kind.name},
            h('label', {class: 'switch'}, box, h('code', null, kind.name)), h('small', null, kind.help),
            h('details', null, h('summary', null, 'Attributes'), inputs.map(({attribute, input}) =>
                h('label', {class: 'attribute', title: attribute.help}, h('span', null, attribute.name), input))))};
        return card;
    }

    function draw(list) {
        const text = JSON.stringify(list);
        if (text === drawn) return;
        drawn = text;
        for (const card of cards) card.ids = [];
        for (const each of list)
            if (!each.over) cards.find(card => card.name === each.fault.kind)?.ids.push(each.id);
        for (const card of cards) {
            card.box.checked = card.ids.length > 0;
            card.element.classList.toggle('on', card.ids.length > 0);
        }
        refill(force, list.length === 0 ? h('p', {class: 'empty'}, 'Nothing is broken.') : list.map(each =>
            h('div', {class: 'field', 'data-fault': each.id}, h('div', {class: 'name'}, h('code', null, spec_text(each.fault)),
                h('small', null, deeds(each))), h('button', {class: 'plain', onclick: () => attempt('faults.remove', {fault: each.id})}, 'Remove'))));
        show(clear, list.length > 0);
    }

    async function look() {
        clearTimeout(timer);
        if (ended) return;
        try {
            draw((await board.op('faults.list')).faults);
        } catch (error) {
            if (!(error instanceof Refused)) throw error;
        }
        if (!ended) timer = setTimeout(look, 1000);
    }
    look();
    return () => {
        ended = true;
        clearTimeout(timer);
    };
}

function kinds(words) {
    return [...words.kinds.map(kind => [kind, words.common, false]), ...words.printer.kinds.map(kind => [kind, words.printer.common, true])];
}

function attribute_input(attribute) {
    if (attribute.choices)
        return h('select', {'aria-label': attribute.name}, h('option', {value: ''}, attribute.default === undefined ? '–' : String(attribute.default)),
                 attribute.choices.map(choice => h('option', null, choice)));
    const numeric = attribute.type === 'number' || attribute.type === 'integer';
    return h('input', {type: numeric ? 'number' : 'text', step: 'any', 'aria-label': attribute.name,
                       placeholder: attribute.default === undefined ? (attribute.type === 'time' ? '10s' : '') : String(attribute.default),
                       title: attribute.help + ' (' + attribute.min + ' to ' + attribute.max + ')'});
}

function typed(attribute, text) {
    return attribute.type === 'number' || attribute.type === 'integer' ? Number(text) : text;
}

function spec_text(fault) {
    const {kind, ...rest} = fault;
    const parts = Object.entries(rest).map(([key, value]) => key + '=' + value);
    return parts.length ? kind + ': ' + parts.join(', ') : kind;
}

function deeds(each) {
    if (each.state !== undefined) return each.state === 'waiting' ? 'begins at ' + time_text(each.begin) : each.state + ' since ' + time_text(each.begin);
    return 'acted ' + each.acted + (each.acted === 1 ? ' time' : ' times') + ' on ' + each.seen + ' lines' + (each.over ? '; over' : '');
}
