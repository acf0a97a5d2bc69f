// All boards at a glance.

import {h, say, show, time_text} from './dom.js';

export function mount(root, boards) {
    const filter = h('input', {type: 'search', placeholder: 'Filter', 'aria-label': 'Filter boards', oninput: sift});
    const grid = h('div', {class: 'boards'});
    root.append(h('div', {class: 'tools'}, filter, h('span', {class: 'quiet'}, boards.length + ' boards in one process')), grid);
    const cards = boards.map((board, number) => {
        const parts = {clock: h('span', {class: 'quiet'}), line: h('span', {class: 'badge'}), words: h('p', {class: 'words'}),
                       bar: h('progress', {max: 100, value: 0, hidden: true}), trouble: h('span', {class: 'badge bad', hidden: true})};
        const element = h('a', {class: 'card board', href: '#/' + number + '/overview'},
            h('h2', null, board.name, ' ', parts.line, parts.trouble), h('p', {class: 'quiet'}, board.title || board.profile, ' · ', parts.clock), parts.words, parts.bar);
        grid.append(element);
        return {...parts, element, text: (board.name + ' ' + board.profile + ' ' + (board.title || '')).toLowerCase()};
    });
    function sift() {
        for (const card of cards) show(card.element, card.text.includes(filter.value.toLowerCase()));
    }
    let source = null, timer = null, tries = 0;
    function open() {
        source = new EventSource('shelf');
        source.onmessage = event => {
            tries = 0;
            document.body.classList.remove('lost');
            show(document.getElementById('gone'), false);
            for (const each of JSON.parse(event.data)) draw(cards[each.n], each);
        };
        source.onerror = () => {
            source.close();
            document.body.classList.add('lost');
            const gone = document.getElementById('gone');
            say(gone, 'The boards are gone: their run has ended, or this computer cannot reach it. Trying again…');
            show(gone, true);
            timer = setTimeout(open, Math.min(250 * 2 ** tries++, 2000));
        };
    }
    function draw(card, now) {
        if (!card) return;
        if (now.t !== undefined) say(card.clock, time_text(now.t));
        if (now.link !== undefined) {
            say(card.line, now.link === 'up' ? 'in use' : 'nobody');
            card.line.className = 'badge ' + (now.link === 'up' ? 'good' : 'idle');
        }
        if (now.words !== undefined) say(card.words, now.words);
        if (now.progress !== undefined) {
            card.bar.value = now.progress || 0;
            show(card.bar, now.progress !== null && now.progress > 0);
        }
        if (now.faults !== undefined) {
            say(card.trouble, now.faults + (now.faults === 1 ? ' fault' : ' faults'));
            show(card.trouble, now.faults > 0);
        }
    }
    open();
    return () => {
        clearTimeout(timer);
        source.close();
    };
}
