// SPDX-License-Identifier: Apache-2.0
function roundStep(low, high, count) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough)), share = rough / power;
  return power * (share > 5 ? 10 : share > 2 ? 5 : share > 1 ? 2 : 1);
}

function roundSteps(low, high, count) {
  const step = roundStep(low, high, count), out = [];
  for (let n = Math.ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; ++n)
    out.push(n * step);
  return out;
}

// A range that begins and ends with a step.
function roundEnds(low, high, count) {
  const step = roundStep(low, high, count);
  return [Math.floor(low / step + 1e-9) * step, Math.ceil(high / step - 1e-9) * step];
}

// The next of 1, 2 and 5 times a power of ten.
function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].find(factor => factor * power >= value * 0.999999) * power;
}

function logSteps(low, high) {
  const all = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); ++power)
    for (let factor = 1; factor < 10; ++factor)
      all.push({factor, value: factor * 10 ** power});
  for (const factors of [[1], [1, 2, 5], [1, 2, 3, 4, 5, 6, 7, 8, 9]]) {
    const steps = all.filter(s => factors.includes(s.factor) && s.value >= low * 0.999 && s.value <= high * 1.001);
    if (steps.length > 2 || factors.length === 9)
      return steps.map(s => s.value);
  }
}

const kPlot = {left: 76, right: 596, top: 14, bottom: 350};

function frame(svg, x, y, xTitle, yTitle) {
  const axis = draw('g', {class: 'axis'});
  for (const [at, label] of x) {
    axis.append(draw('line', {class: 'grid', x1: at, x2: at, y1: kPlot.top, y2: kPlot.bottom}),
                draw('text', {x: at, y: kPlot.bottom + 18, 'text-anchor': 'middle'}, label));
  }
  for (const [at, label] of y) {
    axis.append(draw('line', {class: 'grid', x1: kPlot.left, x2: kPlot.right, y1: at, y2: at}),
                draw('text', {x: kPlot.left - 8, y: at + 4, 'text-anchor': 'end'}, label));
  }
  const middle = (kPlot.top + kPlot.bottom) / 2;
  axis.append(draw('text', {x: (kPlot.left + kPlot.right) / 2, y: 390, 'text-anchor': 'middle'}, xTitle),
              draw('text', {transform: `translate(12 ${middle}) rotate(-90)`, 'text-anchor': 'middle'}, yTitle));
  svg.append(axis);
}
