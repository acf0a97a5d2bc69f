// The print: file, progress, layer, times; the way of the head, or the picture of the layer.

import {bytes_text, h, s, say, show, time_text, value_text} from './dom.js';

export const title = 'Print';

/** What a person wants to know, and the fields that tell it; the first that the machine has counts. */
const facts = [
    ['File', ['print.file', 'job.name', 'resin.file'], text => text || '–'],
    ['Progress', ['print.percent', 'job.progress'], value => Math.round(value) + ' %'],
    ['Layer', ['print.layer', 'job.layer'], (value, board) => of(value, board, ['print.layers', 'job.layers'])],
    ['Printed for', ['print.elapsed_s', 'job.seconds'], time_text],
    ['Estimate', ['print.estimate_s', 'job.estimate'], value => value > 0 ? time_text(value) : '–'],
    ['Place', ['job.byte'], (value, board) => bytes_text(value) + ' of ' + bytes_text(board.state['job.bytes'] || 0)],
    ['Head', ['position.x'], (value, board) => ['x', 'y', 'z'].map(axis => axis.toUpperCase() + ' ' + (board.state['position.' + axis] ?? 0).toFixed(2)).join('  ')],
    ['Height', ['platform.height', 'resin.z'], value => value.toFixed(3) + ' mm'],
    ['LED', ['lamp.on', 'resin.led'], value => value ? 'on' : 'off'],
    ['Phase', ['print.state', 'resin.phase'], text => String(text).replaceAll('_', ' ')],
];

function of(value, board, totals) {
    const total = totals.map(path => board.state[path]).find(each => each !== undefined && each !== null);
    return total ? value + ' of ' + total : String(value);
}

export function mount(root, board, {small = false} = {}) {
    const bar = h('progress', {max: 100, value: 0, 'aria-label': 'Progress'});
    const list = h('dl', {class: 'facts'});
    const picture = h('div', {class: small ? 'picture' : 'picture card'});
    root.append(h('div', {class: small ? 'print-head' : 'print-head card'}, bar, list), picture);
    const rows = [];
    for (const [name, paths, word] of facts) {
        const path = paths.find(each => board.state[each] !== undefined && board.state[each] !== null);
        if (!path) continue;
        const value = h('dd', null, '');
        list.append(h('div', null, h('dt', null, name), value));
        rows.push({path, word, value});
    }
    function update() {
        for (const row of rows) {
            const now = board.state[row.path];
            say(row.value, now === null || now === undefined ? '–' : row.word(now, board));
        }
        const progress = ['print.percent', 'job.progress'].map(path => board.state[path]).find(each => typeof each === 'number');
        bar.value = progress || 0;
    }
    update();
    const draw = drawer(picture);
    const stops = [board.on('state', update), board.on('drawing', message => draw(message.drawing))];
    const topic = board.subscribe('drawing');
    board.op('drawing').then(answer => draw(answer.drawing), () => {});
    return () => {
        stops.forEach(stop => stop());
        topic.then(stop => stop());
    };
}

/** Draws what the board draws: a way in the plane, or a picture. */
function drawer(root) {
    let layers = [], svg = null, image = null, size = '';
    const note = h('p', {class: 'quiet'});
    root.append(note);
    say(note, 'Nothing is being printed.');

    function start_way(way) {
        const [width, depth] = way.size;
        svg?.remove();
        svg = s('svg', {class: 'bed', viewBox: '-2 -2 ' + (width + 4) + ' ' + (depth + 4), role: 'img', 'aria-label': 'Bed from above'},
            s('rect', {class: 'plate', x: 0, y: 0, width, height: depth, rx: 4}), grid(width, depth),
            s('path', {class: 'below'}), s('path', {class: 'way'}), s('circle', {class: 'head', r: Math.max(width, depth) / 80, cx: 0, cy: depth}));
        root.prepend(svg);
        size = width + ' ' + depth;
    }

    function draw_way(way) {
        if (size !== way.size.join(' ')) start_way(way);
        show(svg, true);
        const depth = way.size[1];
        if (!way.more) layers = [];
        for (const part of way.layers) {
            const known = layers.find(each => each.z === part.z);
            const d = part.d.map(points => 'M' + points.reduce((text, value, i) =>
                text + (i % 2 === 0 ? (i ? 'L' : '') + value : ' ' + round(depth - value)), '')).join('');
            if (known) known.d += d;
            else layers.push({z: part.z, d});
        }
        layers = layers.slice(-2);
        svg.querySelector('.way').setAttribute('d', layers.length ? layers[layers.length - 1].d : '');
        svg.querySelector('.below').setAttribute('d', layers.length > 1 ? layers[0].d : '');
        const head = svg.querySelector('.head');
        head.setAttribute('cx', way.head[0]);
        head.setAttribute('cy', depth - way.head[1]);
        say(note, layers.length ? 'Layer at Z ' + value_text(layers[layers.length - 1].z, 'mm') + (layers.length > 1 ? ', the one below pale' : '')
                                : 'Bed ' + way.size.join(' × ') + ' mm. Nothing has been extruded yet.');
    }

    /** Four greys a byte, the darkest bits first. */
    function draw_picture(picture) {
        if (!image) {
            image = h('canvas', {class: 'layer', role: 'img'});
            root.prepend(image);
        }
        show(image, true);
        if (picture.greys) {
            const bytes = atob(picture.greys), pixels = new ImageData(picture.width, picture.height);
            for (let i = 0; i < picture.width * picture.height; ++i) {
                const grey = (bytes.charCodeAt(i >> 2) >> (i % 4 * 2) & 3) * 85;
                pixels.data.set([grey, grey, grey, 255], i * 4);
            }
            image.width = picture.width;
            image.height = picture.height;
            image.getContext('2d').putImageData(pixels, 0, 0);
        }
        image.setAttribute('aria-label', picture.words);
        image.classList.toggle('lit', Boolean(picture.lit));
        say(note, picture.words);
    }

    return drawing => {
        if (!drawing) return;
        if (drawing.way) draw_way(drawing.way);
        if (drawing.picture) draw_picture(drawing.picture);
    };
}

function round(value) {
    return Math.round(value * 1000) / 1000;
}

function grid(width, depth) {
    const lines = [];
    for (let x = 50; x < width; x += 50) lines.push(s('line', {x1: x, x2: x, y1: 0, y2: depth}));
    for (let y = 50; y < depth; y += 50) lines.push(s('line', {x1: 0, x2: width, y1: depth - y, y2: depth - y}));
    return s('g', {class: 'grid'}, lines);
}
