// What one looks at while the board runs by itself: the other views, small, beside each other.

import {h} from './dom.js';
import * as screen from './screen.js';
import * as curves from './curves.js';
import * as print from './print.js';
import * as talk from './talk.js';

export const title = 'Overview';

const parts = [[screen, 'screen'], [curves, 'curves'], [print, 'print'], [talk, 'talk']];

export function mount(root, board) {
    const ends = parts.map(([view, name]) => {
        const body = h('div', {class: 'body ' + name});
        root.append(h('section', {class: 'card ' + name},
            h('h2', null, h('a', {href: '#/' + board.number + '/' + name}, view.title)), body));
        return view.mount(body, board, {small: true});
    });
    return () => ends.forEach(end => end());
}
