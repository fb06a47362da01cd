// SPDX-License-Identifier: Apache-2.0
// BlockGrid of formats/image.
function middle(square, side, first, last) {
  const from = first + square * side, to = Math.min(from + side - 1, last);
  return from + Math.floor((to - from) / 2);
}

async function drawPlace() {
  if (state.column === null)
    return;
  const {column, row, choice} = state, [minX, minY, maxX, maxY] = page.window;
  for (const stage of document.querySelectorAll('.stage')) {
    const cross = stage.querySelector('.cross') ?? stage.appendChild(make('div', {class: 'cross'}));
    cross.style.cssText = `left: ${100 * column / page.columns}%; top: ${100 * row / page.rows}%; ` +
      `width: max(3px, ${100 / page.columns}%); height: max(3px, ${100 / page.rows}%)`;
  }
  const codes = await spectraCodes, map = await mapOf(choice);
  if (column !== state.column || row !== state.row || choice !== state.choice)
    return;
  const ratio = spectra.side / page.side, sColumn = Math.floor(column / ratio), sRow = Math.floor(row / ratio);
  const x = middle(sColumn, spectra.side, minX, maxX), y = middle(sRow, spectra.side, minY, maxY);
  const values = spectra.wavelengths_nm.map((_, band) =>
    half(codes[(band * spectra.rows + sRow) * spectra.columns + sColumn]) * spectra.factor);
  const code = map[row * page.columns + column];
  const delta = code === kUndefined ? 'none' : difference(code * page.choices[choice].factor);
  const left = minX + column * page.side, top = minY + row * page.side;
  const where = page.side === 1 ? `pixel ${left}, ${top}`
    : `pixels ${left}–${Math.min(left + page.side - 1, maxX)}, ${top}–${Math.min(top + page.side - 1, maxY)}`;
  byId('place').textContent = `${where}: ${page.side === 1 ? '' : 'largest '}CIEDE2000 ${delta} under ${choices[choice].choice}` +
    (spectra.side === 1 ? '' : `; spectrum of pixel ${x}, ${y}`);
  byId('place').dataset.deltaE = code === kUndefined ? 'NaN' : code * page.choices[choice].factor;
  drawCurve(values, x, y);
}

function drawCurve(values, pixelX, pixelY) {
  const svg = byId('curve'), nm = spectra.wavelengths_nm, finite = values.filter(Number.isFinite);
  const peak = Math.max(0, ...finite), least = Math.min(0, ...finite);
  const [low, high] = roundEnds(least, peak === least ? 1 : peak, 5);
  const room = nm.length > 1 ? 0 : 10, first = nm[0] - room, last = nm[nm.length - 1] + room;
  const x = w => kPlot.left + (w - first) / ((last - first) || 1) * (kPlot.right - kPlot.left);
  const y = v => kPlot.bottom - (v - low) / (high - low) * (kPlot.bottom - kPlot.top);
  svg.replaceChildren();
  frame(svg, roundSteps(first, last || first + 1, 8).map(w => [x(w), digits(w)]),
        roundSteps(low, high, 5).map(v => [y(v), digits(v)]), 'wavelength, nm',
        spectra.units ? `${spectra.quantity}, ${spectra.units} per nm` : `${spectra.quantity}, share`);
  const places = values.map((v, i) => Number.isFinite(v) ? `${x(nm[i]).toFixed(1)},${y(v).toFixed(1)}` : null);
  svg.append(draw('polyline', {class: 'curve', points: places.filter(Boolean).join(' ')}));
  const marks = draw('g', {class: 'bands'});
  values.forEach((v, i) => {
    if (Number.isFinite(v))
      marks.append(draw('circle', {cx: x(nm[i]), cy: y(v), r: nm.length > 120 ? 1.2 : 2.6, 'data-nm': nm[i], 'data-value': v},
        draw('title', {}, `${digits(nm[i])} nm: ${Number(v.toPrecision(5))}`)));
  });
  svg.append(marks);
  svg.dataset.x = pixelX;
  svg.dataset.y = pixelY;
  svg.setAttribute('aria-label', `Spectrum of pixel ${pixelX}, ${pixelY}: ${nm.length} bands from ${digits(nm[0])} to ` +
    `${digits(nm[nm.length - 1])} nm, largest value ${digits(peak)}`);
}

function goTo(column, row) {
  state.column = Math.min(Math.max(column, 0), page.columns - 1);
  state.row = Math.min(Math.max(row, 0), page.rows - 1);
  drawPlace();
}

// Narrow images would be lines on the screen.
const shape = page.columns / page.rows, drawnShape = Math.min(Math.max(shape, 0.4), 8), stretched = shape !== drawnShape;

function prepareStages() {
  for (const stage of document.querySelectorAll('.stage')) {
    stage.style.aspectRatio = drawnShape;
    stage.style.maxWidth = `calc(75vh * ${drawnShape})`;
    stage.classList.toggle('coarse', page.columns < 300);
    const follow = event => {
      const box = stage.getBoundingClientRect();
      goTo(Math.floor((event.clientX - box.left) / box.width * page.columns),
           Math.floor((event.clientY - box.top) / box.height * page.rows));
    };
    stage.addEventListener('pointermove', follow);
    stage.addEventListener('pointerdown', follow);
    stage.addEventListener('keydown', event => {
      const step = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
      if (!step)
        return;
      event.preventDefault();
      const by = event.shiftKey ? 10 : 1;
      if (state.column === null)
        goTo(Math.floor(page.columns / 2), Math.floor(page.rows / 2));
      else
        goTo(state.column + by * step[0], state.row + by * step[1]);
    });
  }
}
