// One board: its operations (the control channel's), and what it tells unasked.

/** A request that was refused. `code` and `nearest` are the control channel's. */
export class Refused extends Error {
    constructor(error) {
        super(error.nearest ? error.message + ' Did you mean ' + error.nearest + '?' : error.message);
        this.code = error.code;
    }
}

const retry_ms = [250, 500, 1000, 2000];

export class Board extends EventTarget {
    /** Connects at once and, when the connection is lost, again and again. */
    constructor(number) {
        super();
        this.number = number;
        this.state = {};       // field: value
        this.t = 0;            // virtual time of the last word, seconds
        this.link = {};        // state, kind, path
        this.up = false;
        this.waiting = new Map();
        this.next_id = 1;
        this.tries = 0;
        this.pace = {real: 0, virtual: 0, every: 0.5};
        this.open();
    }

    open() {
        this.source = new EventSource('live/' + this.number);
        this.source.onmessage = event => this.hear(JSON.parse(event.data));
        this.source.onerror = () => this.lost();
    }

    close() {
        this.closed = true;
        clearTimeout(this.timer);
        this.source.close();
        this.drop('The view was closed.');
    }

    lost() {
        this.source.close();
        if (this.closed) return;
        const was_up = this.up;
        this.up = false;
        this.drop('The connection to the board was lost.');
        if (was_up || this.tries === 0) this.tell('gone');
        this.timer = setTimeout(() => this.open(), retry_ms[Math.min(this.tries++, retry_ms.length - 1)]);
    }

    drop(why) {
        for (const {reject} of this.waiting.values()) reject(new Refused({message: why, code: 'lost'}));
        this.waiting.clear();
    }

    tell(type, detail) {
        this.dispatchEvent(new CustomEvent(type, {detail}));
    }

    /** Calls back with the detail of each event of that type; returns how to stop it. */
    on(type, call) {
        const listener = event => call(event.detail);
        this.addEventListener(type, listener);
        return () => this.removeEventListener(type, listener);
    }

    hear(message) {
        if (message.session !== undefined) return this.begin(message);
        if (message.id !== undefined || message.ok !== undefined) return this.answer(message);
        if (typeof message.t === 'number' && message.t > this.t) this.t = message.t;
        if (message.event === 'state') {
            Object.assign(this.state, message.fields);
            this.keep_pace();
        } else if (message.event === 'link') {
            Object.assign(this.link, {state: message.state, why: message.why});
        } else if (message.event === 'lost') {
            this.watch_state();
        }
        this.tell(message.event, message);
    }

    async begin(message) {
        this.session = message.session;
        this.up = true;
        this.wanted = new Map();
        this.tries = 0;
        this.t = 0;
        this.state = {};
        this.pace.real = 0;
        try {
            // One after the other: the words fill all the room that answers have.
            const status = await this.op('status');
            Object.assign(this.state, (await this.op('get')).fields);
            const words = await this.op('describe', {what: ['fields', 'variables', 'actions', 'faults', 'frames']});
            this.status = status;
            this.t = status.t;
            this.link = status.link;
            this.words = words;
            this.fields = new Map(words.fields.concat(words.variables).map(field => [field.path, field]));
            this.pace.every = Math.max(0.4 * status.speed, 0.5);
            await Promise.all([this.watch_state(), this.op('subscribe', {topic: 'link'}), this.op('subscribe', {topic: 'notices'})]);
            this.tell('begin');
        } catch (error) {
            if (error.code === 'lost') return;
            if (!(error instanceof Refused)) throw error;
            this.lost();  // and anew
        }
    }

    watch_state() {
        return this.op('subscribe', {topic: 'state', every: Math.min(Math.max(this.pace.every, 0.05), 3600)}).catch(() => {});
    }

    /** A board may run faster than time: what a person can follow is some two looks a second of theirs. */
    keep_pace() {
        const now = performance.now() / 1000, pace = this.pace;
        if (this.status.speed > 0 || now - pace.real < 2) return;
        if (pace.real > 0) {  // as fast as it goes: that has to be measured
            pace.every = Math.max(0.4 * (this.t - pace.virtual) / (now - pace.real), 0.5);
            this.watch_state();
        }
        pace.real = now;
        pace.virtual = this.t;
    }

    answer(message) {
        const asked = this.waiting.get(message.id);
        if (!asked) return;
        this.waiting.delete(message.id);
        if (message.ok) asked.resolve(message);
        else asked.reject(new Refused(message.error));
    }

    /** An operation by its name. Resolves with the answer, rejects with Refused. */
    op(name, parameters) {
        const id = this.next_id++;
        return new Promise((resolve, reject) => {
            if (!this.up) return reject(new Refused({message: 'There is no connection to the board.', code: 'lost'}));
            this.waiting.set(id, {resolve, reject});
            fetch('live/' + this.number + '/' + this.session, {
                method: 'POST', body: JSON.stringify({id, op: name, ...parameters}) + '\n'
            }).then(async reply => {
                if (reply.ok) return;
                this.waiting.delete(id);
                reject(new Refused({message: await reply.text(), code: 'http'}));
            }, () => {
                this.waiting.delete(id);
                reject(new Refused({message: 'The connection to the board was lost.', code: 'lost'}));
            });
        });
    }

    /** A topic for as long as somebody wants it; returns how to stop. */
    async subscribe(topic, more) {
        const count = this.wanted.get(topic) || 0;
        this.wanted.set(topic, count + 1);
        if (count === 0) await this.op('subscribe', {topic, ...more}).catch(() => {});
        return () => {
            const left = this.wanted.get(topic) - 1;
            this.wanted.set(topic, left);
            if (left === 0 && this.up) this.op('unsubscribe', {topic}).catch(() => {});
        };
    }
}
