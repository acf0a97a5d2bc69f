// The steps of the scenario that is played, and how it stands.

import {h, refill, time_text} from './dom.js';

export const title = 'Scenario';

const marks = {passed: '✓', failed: '✗', running: '▶', waiting: ''};

export function mount(root, board) {
    const head = h('section', {class: 'card'});
    const steps = h('ol', {class: 'steps'});
    root.append(head, steps);

    function draw(scenario) {
        if (!scenario) {
            refill(head, h('p', {class: 'empty'}, 'No scenario is played. Start one with “run --script NAME --web”.'));
            return;
        }
        refill(head, h('h2', null, scenario.title || scenario.name),
            h('p', {class: 'verdict ' + (scenario.verdict || 'running')}, scenario.sentence || 'Under way.'),
            scenario.branches.length ? h('ul', {class: 'branches'}, scenario.branches.map(branch =>
                h('li', null, h('code', null, branch.name || 'main'), ' ', branch.words, branch.since === undefined ? null :
                    h('small', null, ' since ' + time_text(branch.since))))) : null);
        refill(steps, scenario.steps.map(step => h('li', {class: step.state, 'aria-current': step.state === 'running' ? 'step' : null},
            h('span', {class: 'tick', 'aria-label': step.state}, marks[step.state] || ''), h('span', null, step.words),
            h('small', null, step.at === undefined ? '' : time_text(step.at)), step.sentence ? h('p', {class: 'error'}, step.sentence) : null)));
    }
    const end = board.on('scenario', message => draw(message.scenario));
    const topic = board.subscribe('scenario');
    board.op('scenario').then(answer => draw(answer.scenario), () => {});
    return () => {
        end();
        topic.then(stop => stop());
    };
}
