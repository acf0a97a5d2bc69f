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

    const end_screen = board.on('screen', message => message.screen && draw(message.screen));
    const unsubscribe = board.subscribe('screen');
    let end_pixels = null, ended = false;
    board.op('screen').then(answer => {
        if (ended) return;
        if (answer.screen) draw(answer.screen);
        else end_pixels = show_pixels(face, fault, board, () => root.replaceChildren(h('p', {class: 'empty'}, 'No screen is known for this profile.')));
    }, () => {});
    return () => {
        ended = true;
        end_screen();
        if (end_pixels) end_pixels();
        unsubscribe.then(stop => stop());
    };
}

const look_ms = 400;
const picture_ms = 2000;

/** A board with a screen of its own: its picture, and over it a button for each control. */
function show_pixels(face, fault, board, on_none) {
    const image = h('img', {alt: 'The screen of the board', draggable: 'false'});
    const controls = h('div', {class: 'controls'});
    let timer = null, ended = false, drawn = '', drawn_at = 0;
    face.classList.add('pixels');
    refill(face, image, controls);

    async function touch(where) {
        show(fault, false);
        try {
            await board.op('touch', where);
        } catch (error) {
            if (!(error instanceof Refused)) throw error;
            say(fault, error.message);
            show(fault, true);
        }
        look();
    }
    image.addEventListener('click', event => {
        const box = image.getBoundingClientRect();
        touch({x: Math.floor((event.clientX - box.left) * image.naturalWidth / box.width),
               y: Math.floor((event.clientY - box.top) * image.naturalHeight / box.height)});
    });

    function place(page) {
        const focus = controls.contains(document.activeElement) ? document.activeElement.title : null;
        refill(controls, page.controls.map(control => {
            const key = h('button', {class: 'spot', title: control.label || control.name, 'aria-label': control.label || control.name,
                                     disabled: control.enabled === false, onclick: () => touch({control: control.name})});
            key.style.left = control.x / image.naturalWidth * 100 + '%';
            key.style.top = control.y / image.naturalHeight * 100 + '%';
            key.style.width = control.w / image.naturalWidth * 100 + '%';
            key.style.height = control.h / image.naturalHeight * 100 + '%';
            return key;
        }));
        if (focus) for (const key of controls.children) if (key.title === focus) key.focus();
        image.alt = [page.title, ...page.texts, page.box ? page.box.text : ''].filter(Boolean).join('. ');
    }

    async function look() {
        clearTimeout(timer);
        try {
            const page = await board.op('page');
            const text = JSON.stringify({...page, id: 0});
            if (text !== drawn || performance.now() - drawn_at > picture_ms) {
                const picture = await board.op('screenshot');
                if (ended) return;
                image.src = 'data:image/png;base64,' + picture.png;
                await image.decode();
                drawn_at = performance.now();
                if (text !== drawn) place(page);
                drawn = text;
            }
        } catch (error) {
            if (error.code === 'not-here') return ended ? undefined : on_none();
        }
        if (!ended) {
            clearTimeout(timer);
            timer = setTimeout(look, look_ms);
        }
    }
    look();
    return () => {
        ended = true;
        clearTimeout(timer);
    };
}

function page_of(text) {
    return text ? JSON.parse(text).page : null;
}
