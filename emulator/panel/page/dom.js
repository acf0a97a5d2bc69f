// Elements made from data. Text is only ever set as text.

const svg_space = 'http://www.w3.org/2000/svg';

/** An element. `props`: on… are listeners, true sets a bare attribute, null and false none. */
export function h(name, props, ...children) {
    return fill(document.createElement(name), props, children);
}

/** The same of SVG. */
export function s(name, props, ...children) {
    return fill(document.createElementNS(svg_space, name), props, children);
}

function fill(made, props, children) {
    for (const [key, value] of Object.entries(props || {})) {
        if (value === null || value === undefined || value === false) continue;
        if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
        else made.setAttribute(key, value === true ? '' : String(value));
    }
    put(made, children);
    return made;
}

function put(parent, children) {
    for (const child of children) {
        if (Array.isArray(child)) put(parent, child);
        else if (child !== null && child !== undefined && child !== false)
            parent.append(child instanceof Node ? child : document.createTextNode(String(child)));
    }
}

export function refill(parent, ...children) {
    parent.replaceChildren();
    put(parent, children);
    return parent;
}

/** Sets text only where it differs: cheap, and a selection stays. */
export function say(element, text) {
    if (element.textContent !== text) element.textContent = text;
}

export function show(element, shown) {
    if (element.hidden === shown) element.hidden = !shown;
}

/** A value of a field for a person. */
export function value_text(value, unit) {
    if (value === null || value === undefined) return '–';
    if (value === true) return 'yes';
    if (value === false) return 'no';
    if (typeof value === 'number') {
        const text = Number.isInteger(value) ? String(value) : String(Number(value.toFixed(3)));
        return unit ? text + ' ' + unit_text(unit) : text;
    }
    return String(value);
}

const units = {C: '°C', 'K/s': 'K/s'};
export function unit_text(unit) {
    return units[unit] || unit;
}

/** Seconds as a clock: 12.3 s, 4:05, 1:02:03, 3 d 04:05:06. */
export function time_text(seconds) {
    if (!Number.isFinite(seconds)) return '–';
    if (seconds < 60) return seconds.toFixed(1) + ' s';
    const two = number => String(Math.floor(number)).padStart(2, '0');
    const s = seconds % 60, m = seconds / 60 % 60, hours = seconds / 3600;
    const days = Math.floor(hours / 24);
    if (days > 0) return days + ' d ' + two(hours % 24) + ':' + two(m) + ':' + two(s);
    return hours >= 1 ? Math.floor(hours) + ':' + two(m) + ':' + two(s) : Math.floor(m) + ':' + two(s);
}

export function bytes_text(bytes) {
    return bytes < 10000 ? bytes + ' B' : bytes < 1e7 ? (bytes / 1000).toFixed(1) + ' kB' : (bytes / 1e6).toFixed(1) + ' MB';
}

/** A file of the reader's own, made here. */
export function save(name, blob) {
    const link = h('a', {href: URL.createObjectURL(blob), download: name});
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
