// SPDX-License-Identifier: Apache-2.0
// The front, as formats/trade/table.cpp marks it.

const sameTime = (a, b) => a.fastest <= b.slowest && b.fastest <= a.slowest;

function beats(a, b) {
  const same = sameTime(a, b), faster = !same && a.seconds < b.seconds;
  return a.delta_e_max <= b.delta_e_max && (faster || (same && a.delta_e_max < b.delta_e_max));
}

function verdict(choice) {
  const price = choice.delta_e_max === 0 ? 'No pixel differs from the reference'
      : `Pixels are up to ${difference(choice.delta_e_max)} CIEDE2000 from the reference`;
  const time = choice.choice === 'exact' ? 'this is the exact collapse'
      : choice.against_exact === 'same' ? 'noise hides whether it is faster or slower than exact'
      : `it takes ${choice.against_exact} of the time of exact`;
  if (choice.front)
    return `${choice.choice}: ${choice.meaning}. ${price}; ${time}. On the front.`;
  const better = choices.filter(other => beats(other, choice))
      .sort((a, b) => a.delta_e_max - b.delta_e_max || a.seconds - b.seconds)[0];
  const how = (better.delta_e_max < choice.delta_e_max ? 'nearer' : 'as near') +
      (sameTime(better, choice) ? ' and as fast' : ' and faster');
  return `${choice.choice}: ${choice.meaning}. ${price}; ${time}. Not worth taking: ${better.choice} is ${how}.`;
}

const places = [];  // of the choices' points

function drawPlot() {
  const svg = byId('plot'), key = state.measure;
  svg.replaceChildren();
  const low = Math.min(...choices.map(c => c.fastest)) / 1.15, high = Math.max(...choices.map(c => c.slowest)) * 1.15;
  const x = s => kPlot.left + Math.log(s / low) / Math.log(high / low) * (kPlot.right - kPlot.left);
  // Zero has no logarithm: it has a line of its own below the axis's end.
  const zeroAt = kPlot.bottom - 12, floorAt = kPlot.bottom - 40;
  const positive = choices.map(c => c[key]).filter(d => d > 0);
  const top = positive.length ? Math.max(...positive) * 2 : 1;
  const floor = positive.length ? Math.max(10 ** Math.floor(Math.log10(Math.min(...positive))), top * 1e-7) : 0.1;
  const y = d => d > 0 ? floorAt - Math.log(Math.max(d, floor) / floor) / Math.log(top / floor) * (floorAt - kPlot.top)
                       : zeroAt;
  frame(svg, logSteps(low, high).map(s => [x(s), digits(s)]),
        [[zeroAt, '0'], ...(positive.length ? logSteps(floor, top).map(d => [y(d), digits(d)]) : [])],
        'seconds from file to file, median', `CIEDE2000, ${key === 'delta_e_max' ? 'largest' : '99.9 %'}`);
  if (key === 'delta_e_max')
    svg.append(draw('polyline', {class: 'front-line', points:
      choices.filter(c => c.front).map(c => `${x(c.seconds)},${y(c[key])}`).join(' ')}));
  const taken = choices.flatMap(c => [
    {x: x(c.seconds) - 6, y: y(c[key]) - 6, w: 12, h: 12},
    {x: x(c.fastest), y: y(c[key]) - 2, w: x(c.slowest) - x(c.fastest), h: 4}]);
  const order = choices.map((c, i) => i).sort((a, b) => choices[b].front - choices[a].front || a - b);
  const groups = [];
  places.length = 0;
  for (const index of order) {
    const choice = choices[index], cx = x(choice.seconds), cy = y(choice[key]);
    const group = draw('g', {
      class: `point${choice.front ? ' on-front' : ''}${choice.against_exact === 'same' ? ' same' : ''}`,
      role: 'button', tabindex: -1, 'data-choice': choice.choice,
      'aria-label': `${choice.choice}: ${seconds(choice.seconds)} s, CIEDE2000 ${difference(choice[key])}`},
      draw('title', {}, `${choice.choice}: ${seconds(choice.seconds)} s (${seconds(choice.fastest)}–` +
        `${seconds(choice.slowest)}), CIEDE2000 ${difference(choice[key])}`),
      draw('line', {x1: x(choice.fastest), x2: x(choice.slowest), y1: cy, y2: cy}),
      draw('circle', {class: 'halo', cx, cy, r: 8}), draw('circle', {class: 'dot', cx, cy, r: 4}));
    const place = placeLabel(choice.choice, [x(choice.fastest), cx, x(choice.slowest)], cy, taken);
    group.append(draw('text', place ?? {class: 'hidden', x: cx + 10, y: cy - 8}, choice.choice));
    groups[index] = group;
    places[index] = [cx, cy];
  }
  svg.append(...groups);
  markChosen();
}

// Where a name hides no other name and no point; null where there is no such place.
function placeLabel(text, [left, cx, right], cy, taken) {
  const w = text.length * 6 + 2, h = 12;
  const overlap = (a, b) => a.x < b.x + b.w && b.x < a.x + a.w && a.y < b.y + b.h && b.y < a.y + a.h;
  for (const [x, y] of [[Math.max(right, cx + 6) + 3, cy - 6], [Math.min(left, cx - 6) - 3 - w, cy - 6],
                        [cx - w / 2, cy - 20], [cx - w / 2, cy + 8],
                        [cx + 5, cy - 19], [cx + 5, cy + 7], [cx - 5 - w, cy - 19], [cx - 5 - w, cy + 7]]) {
    const box = {x, y, w, h};
    if (x < kPlot.left || x + w > kPlot.right + 20 || y < 0 || y + h > kPlot.bottom || taken.some(t => overlap(box, t)))
      continue;
    taken.push(box);
    return {x: x + 1, y: y + 10};
  }
  return null;
}

// Of points that are close the nearest is meant.
function followPlot() {
  const svg = byId('plot'), kReach = 20;
  const nearest = event => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    const away = places.map(([x, y]) => Math.hypot(at.x - x, at.y - y)), least = Math.min(...away);
    return least < kReach ? away.indexOf(least) : null;
  };
  svg.addEventListener('pointermove', event => pointAt(nearest(event)));
  svg.addEventListener('pointerleave', () => pointAt(null));
  svg.addEventListener('click', event => {
    const index = nearest(event);
    if (index !== null)
      choose(index);
  });
}

const pairOf = index => [byId('plot').querySelector(`[data-choice="${CSS.escape(choices[index].choice)}"]`),
                         byId('table').tBodies[0].rows[index]];

// Marks a choice in plot and table; null: none.
function pointAt(index) {
  for (const element of document.querySelectorAll('.pointed'))
    element.classList.remove('pointed');
  for (const element of index === null ? [] : pairOf(index))
    element.classList.add('pointed');
}

function markChosen() {
  choices.forEach((_, index) => {
    const on = index === state.choice, [point, row] = pairOf(index);
    point.classList.toggle('chosen', on);
    point.setAttribute('tabindex', on ? 0 : -1);
    point.setAttribute('aria-pressed', on);
    row.classList.toggle('chosen', on);
    const button = row.querySelector('button');
    button.setAttribute('aria-pressed', on);
    button.tabIndex = on ? 0 : -1;
  });
}

// Arrows go through the choices where one of them has the focus.
function stepThrough(container, focus) {
  container.addEventListener('keydown', event => {
    const step = {ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1}[event.key];
    if (step) {
      choose(Math.min(Math.max(state.choice + step, 0), choices.length - 1));
      focus(pairOf(state.choice)).focus();
    } else if (event.target.closest('.point') && (event.key === 'Enter' || event.key === ' ')) {
      choose(choices.findIndex(c => c.choice === event.target.closest('.point').dataset.choice));
    } else {
      return;
    }
    event.preventDefault();
  });
}
