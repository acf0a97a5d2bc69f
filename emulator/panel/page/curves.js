// Temperatures, heights, progress over the whole run.

import {h, say, show, save, time_text, unit_text} from './dom.js';

export const title = 'Curves';

const most_points = 4000;
const order = ['C', 'mm', '%'];  // what is looked at most stands first
const colours = ['--c1', '--c2', '--c3', '--c4', '--c5', '--c6', '--c7', '--c8'];
let library = null;

/** dygraphs, when it is needed first. */
function load_library() {
    library = library || new Promise((resolve, reject) => {
        document.head.append(h('link', {rel: 'stylesheet', href: 'dygraph.min.css'}),
            h('script', {src: 'dygraph.min.js', onerror: reject, onload: () => {
                // Ours stands above the plot; the library's would set styles from markup.
                const {Dygraph} = window;
                Dygraph.PLUGINS = Dygraph.PLUGINS.filter(plugin => plugin !== Dygraph.Plugins.Legend);
                resolve();
            }}));
    });
    return library;
}

export function mount(root, board, {small = false} = {}) {
    const tools = h('div', {class: 'tools'},
        h('button', {class: 'plain', onclick: () => charts.forEach(chart => chart.graph?.resetZoom())}, 'Whole run'),
        h('button', {class: 'plain', onclick: save_csv}, 'CSV'),
        h('button', {class: 'plain', onclick: save_png}, 'PNG'),
        h('span', {class: 'quiet'}, 'Drag to zoom, double click for the whole run.'));
    const area = h('div', {class: 'charts'});
    if (!small) root.append(tools);
    root.append(area);
    let charts = [], columns = [], times = [], ended = false, due = null;

    async function begin() {
        const [answer] = await Promise.all([board.op('curves'), load_library()]);
        if (ended) return;
        columns = answer.series.map((series, i) => ({...series, values: answer.values[i]}));
        times = answer.t;
        const by_unit = new Map();
        for (const column of columns) {
            const unit = column.unit || '';
            if (!by_unit.has(unit)) by_unit.set(unit, []);
            by_unit.get(unit).push(column);
        }
        const place = unit => order.includes(unit) ? order.indexOf(unit) : order.length;
        const groups = [...by_unit.entries()].sort(([a], [b]) => place(a) - place(b));
        charts = (small ? groups.slice(0, 1) : groups).map(([unit, group]) => chart(unit, group));
        if (charts.length === 0) area.append(h('p', {class: 'empty'}, 'This machine has nothing that draws a curve.'));
        add(board.state);
        draw();
    }

    function chart(unit, group) {
        const legend = h('div', {class: 'legend'});
        const canvas = h('div', {class: 'plot', 'data-unit': unit});
        area.append(h('figure', {class: 'chart'}, h('figcaption', null, h('span', {class: 'unit'}, unit_text(unit) || 'value'), legend), canvas));
        const made = {unit, group, canvas, legend, graph: null, shown: group.map(() => true)};
        group.forEach((column, i) => {
            column.value = h('b', null, '');
            legend.append(h('button', {class: 'plain series s' + i % colours.length, 'aria-pressed': 'true', title: column.help || column.path, onclick: event => {
                made.shown[i] = !made.shown[i];
                event.currentTarget.setAttribute('aria-pressed', String(made.shown[i]));
                made.graph?.setVisibility(i, made.shown[i]);
            }}, short_name(column.path), ' ', column.value));
        });
        return made;
    }

    /** One more point of all that is drawn, with the values as they are now. */
    function add() {
        const t = board.t;
        if (times.length > 0 && t <= times[times.length - 1]) return;
        times.push(t);
        for (const column of columns) column.values.push(number(board.state[column.path]));
        if (times.length > most_points) thin();
    }

    /** The older half gets half as many points. */
    function thin() {
        const half = most_points >> 1;
        const keep = (unused, i) => i >= half || i % 2 === 0;
        times = times.filter(keep);
        for (const column of columns) column.values = column.values.filter(keep);
    }

    function draw() {
        due = null;
        if (ended || times.length === 0) return;
        for (const made of charts) {
            const data = times.map((t, i) => [t, ...made.group.map(column => column.values[i])]);
            for (const column of made.group) say(column.value, text(column.values[column.values.length - 1]));
            if (made.graph) made.graph.updateOptions({file: data});
            else made.graph = graph(made, data);
        }
    }

    function graph(made, data) {
        const style = getComputedStyle(document.documentElement);
        return new window.Dygraph(made.canvas, data, {
            labels: ['t', ...made.group.map(column => column.path)],
            colors: made.group.map((unused, i) => style.getPropertyValue(colours[i % colours.length]).trim()),
            strokeWidth: 2, legend: 'never', connectSeparatedPoints: false, includeZero: made.unit === '%',
            gridLineColor: style.getPropertyValue('--edge').trim(), axisLineColor: style.getPropertyValue('--edge').trim(),
            axisLabelFontSize: 12, animatedZooms: false, rightGap: 8, yRangePad: 8, xRangePad: 4,
            axes: {x: {axisLabelFormatter: t => time_text(t), pixelsPerLabel: 80}, y: {axisLabelWidth: 44}},
            highlightCallback: (event, x, points) => points.forEach(point => {
                const column = made.group.find(each => each.path === point.name);
                say(column.value, text(point.yval) + ' @ ' + time_text(x));
            }),
            unhighlightCallback: () => made.group.forEach(column => say(column.value, text(column.values[column.values.length - 1]))),
            zoomCallback: (from, to) => charts.forEach(other => other !== made && other.graph && other.graph.updateOptions(
                made.graph.isZoomed('x') ? {dateWindow: [from, to]} : {dateWindow: null}))
        });
    }

    function save_csv() {
        const rows = [['t', ...columns.map(column => column.path)].join(',')];
        times.forEach((t, i) => rows.push([t, ...columns.map(column => column.values[i] ?? '')].join(',')));
        save('curves.csv', new Blob([rows.join('\r\n') + '\r\n'], {type: 'text/csv'}));
    }

    function save_png() {
        const parts = charts.map(made => made.canvas.querySelector('canvas')).filter(Boolean);
        if (parts.length === 0) return;
        const canvas = h('canvas', {width: Math.max(...parts.map(part => part.width)), height: parts.reduce((sum, part) => sum + part.height + 24, 0)});
        const pen = canvas.getContext('2d'), style = getComputedStyle(document.documentElement);
        pen.fillStyle = style.getPropertyValue('--card');
        pen.fillRect(0, 0, canvas.width, canvas.height);
        let y = 0;
        charts.forEach((made, i) => {
            pen.fillStyle = style.getPropertyValue('--text');
            pen.font = '14px sans-serif';
            pen.fillText(unit_text(made.unit) + '   ' + made.group.map(column => column.path).join('   '), 8, y + 17);
            pen.drawImage(parts[i], 0, y + 24);
            y += parts[i].height + 24;
        });
        canvas.toBlob(blob => save('curves.png', blob));
    }

    const end_state = board.on('state', () => {
        if (columns.length === 0) return;
        add();
        if (due === null) due = setTimeout(draw, 250);
    });
    const recolour = () => {
        charts.forEach(made => {
            made.graph?.destroy();
            made.graph = null;
        });
        draw();
    };
    window.addEventListener('themechange', recolour);
    const sized = new ResizeObserver(() => charts.forEach(made => made.graph?.resize()));
    sized.observe(area);
    begin().catch(error => { if (error.code !== 'lost') area.append(h('p', {class: 'error'}, error.message)); });
    return () => {
        ended = true;
        clearTimeout(due);
        end_state();
        sized.disconnect();
        window.removeEventListener('themechange', recolour);
        charts.forEach(made => made.graph?.destroy());
    };
}

/** "heaters.nozzle.true" is the nozzle, "heaters.nozzle.target" its target. */
function short_name(path) {
    return path.slice(path.indexOf('.') + 1).replace(/\.true$/, '').replaceAll('.', ' ');
}

function number(value) {
    return typeof value === 'number' ? value : null;
}

function text(value) {
    return value === null || value === undefined ? '–' : value.toFixed(1);
}
