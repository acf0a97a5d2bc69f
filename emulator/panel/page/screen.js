// The page that a touch screen shows now; its buttons press.

import {Refused} from './board.js';
import {h, refill, say, show} from './dom.js';

export const title = 'Screen';

export function mount(root, board, {small = false} = {}) {
    const face = h('div', {class: 'face', role: 'group', 'aria-label': 'Touch screen'});
    const note = h('p', {class: 'quiet'});
    const fault = h('p', {class: 'error', role: 'alert', hidden: true});
    const sent = h('p', {class: 'sent', 'aria-live': 'polite'});
    root.append(h('div', {class: 'bezel'}, face), fault);
    if (!small) root.append(sent, note);
    let drawn = '';

    async function press(button, row, input) {
        show(fault, false);
        try {
            const answer = await board.op('press', {button, ...(row ? {row} : {}), ...(input === undefined ? {} : {input})});
            say(sent, answer.sent.length ? 'Sent: ' + answer.sent.join(' · ') : 'Sent nothing.');
            draw(answer.screen);
        } catch (error) {
            if (!(error instanceof Refused)) throw error;
            say(fault, error.message);
            show(fault, true);
        }
    }

    function control(button) {
        if (!button.input) {
            return h('button', {class: button.everywhere ? 'key menu' : 'key', disabled: button.shut ? true : null,
                                title: button.shut || button.path, onclick: () => press(button.path, button.row)}, button.label);
        }
        const number = h('input', {type: 'number', min: button.input.min, max: button.input.max, step: 'any',
                                   value: button.input.normally, 'aria-label': button.label, title: button.input.min + ' to ' + button.input.max});
        return h('form', {class: 'key entry', onsubmit: event => {
            event.preventDefault();
            press(button.path, button.row, Number(number.value));
        }}, number, h('button', {title: button.path}, button.label));
    }

    function draw(view) {
        const text = JSON.stringify(view);
        if (text === drawn) return;
        if (face.contains(document.activeElement) && document.activeElement.tagName === 'INPUT' && page_of(drawn) === view.page) return;
        drawn = text;
        const everywhere = view.buttons.filter(button => button.everywhere);
        const focus = face.contains(document.activeElement) ? document.activeElement.title : null;
        refill(face,
            h('div', {class: 'top'}, view.title),
            h('div', {class: 'lines'}, view.lines.map(line => h('p', null, line))),
            h('div', {class: 'keys'}, view.buttons.filter(button => !button.everywhere).map(control)),
            everywhere.length ? h('div', {class: 'keys foot'}, everywhere.map(control)) : null);
        if (focus) for (const key of face.querySelectorAll('button')) if (key.title === focus) key.focus();
        say(note, view.note || '');
    }

    const end_screen = board.on('screen', message => draw(message.screen));
    const unsubscribe = board.subscribe('screen');
    board.op('screen').then(answer => {
        if (answer.screen) return draw(answer.screen);
        root.replaceChildren(h('p', {class: 'empty'}, 'No screen is known for this profile.'));
    }, () => {});
    return () => {
        end_screen();
        unsubscribe.then(stop => stop());
    };
}

function page_of(text) {
    return text ? JSON.parse(text).page : null;
}
