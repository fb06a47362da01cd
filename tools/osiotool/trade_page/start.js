// SPDX-License-Identifier: Apache-2.0
function choose(index) {
  state.choice = index;
  state.flipped = false;
  document.body.dataset.choice = choices[index].choice;
  byId('chosen').textContent = choices[index].choice;
  byId('choices').value = index;
  byId('verdict').textContent = verdict(choices[index]);
  markChosen();
  drawPicture();
  drawNotes();
  drawMap();
  drawPlace();
}

function flip() {
  state.flipped = !state.flipped;
  drawPicture();
}

function start() {
  document.title = `What accuracy costs on ${trade.input}`;
  byId('input').textContent = trade.input;
  byId('about').textContent = `${trade.recipe}. White: Y = ${digits(trade.white_luminance)}, ${trade.white_luminance_from}. ` +
    `Median of ${count(trade.runs, 'run', 'runs')} on ${count(trade.workers, 'worker', 'workers')}.`;
  byId('spectra-note').textContent = `Bands of set ${spectra.set} ` +
    (spectra.side === 1 ? 'at every pixel' : `at the middle pixel of each ${spectra.side}x${spectra.side}`) +
    ', as stored, rounded to 11 significant bits.' +
    (spectra.pairs ? ` The set is fluorescent: its ${spectra.pairs} pairs are not shown.` : '');
  byId('choices').append(...choices.map((c, i) => make('option', {value: i}, c.choice)));
  byId('choices').addEventListener('change', event => choose(Number(event.target.value)));
  byId('flip').addEventListener('click', flip);
  byId('scale').addEventListener('change', event => { state.scale = event.target.value; drawMap(); });
  for (const radio of document.querySelectorAll('[name=measure]'))
    radio.addEventListener('change', () => { state.measure = radio.value; drawPlot(); });
  document.addEventListener('keydown', event => {
    if (event.key === 'f' && !event.ctrlKey && !event.metaKey && !event.altKey && !event.target.closest('select'))
      flip();
  });
  byId('reference').src = pictureOf(referenceIndex);
  drawTable();
  prepareStages();
  drawPlot();
  followPlot();
  stepThrough(byId('plot'), ([point]) => point);
  stepThrough(byId('table').tBodies[0], ([, row]) => row.querySelector('button'));
  choose(0);
}

start();
