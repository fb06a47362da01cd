// SPDX-License-Identifier: Apache-2.0
// The map viridis of matplotlib 1.5 at every ninth of its length (Smith and van der Walt 2015, CC0).
const kViridis = ['#440154', '#482878', '#3e4989', '#31688e', '#26828e', '#1f9e89', '#35b779', '#6ece58', '#b5de2b', '#fde725']
  .map(hex => [1, 3, 5].map(at => parseInt(hex.slice(at, at + 2), 16)));

const kRampEnd = 1023;
const ramp = Array.from({length: kRampEnd + 1}, (_, i) => {
  const place = i / kRampEnd * (kViridis.length - 1), low = Math.min(Math.floor(place), kViridis.length - 2);
  return [...kViridis[low].map((from, c) => from + (place - low) * (kViridis[low + 1][c] - from)), 255];
});
const colourOf = share => ramp[Math.round(Math.min(Math.max(share, 0), 1) * kRampEnd)];

const kNoColour = [128, 128, 128, 255];
const kLeast = 0.01;  // CIEDE2000 that the common scale begins with: a hundredth of what an eye tells apart
const most = Math.max(...choices.map(c => c.delta_e_max));

function scaleOf(choice) {
  if (state.scale === 'own') {
    const largest = choices[choice].delta_e_max || 1;
    return {share: d => d / largest, ticks: [...new Set([0, ...roundSteps(0, largest, 4)])].map(d => [d, digits(d)])};
  }
  const high = Math.max(roundUp(Math.max(most, kLeast)), 1);
  const share = d => d > 0 ? Math.log(d / kLeast) / Math.log(high / kLeast) : 0;
  return {share, ticks: logSteps(kLeast, high).filter(d => /^10*$|^0\.0*1$/.test(digits(d)))
    .map(d => [d, d === kLeast ? `≤ ${kLeast}` : digits(d)])};
}

async function drawMap() {
  const choice = state.choice, canvas = byId('map'), scale = scaleOf(choice), codes = await mapOf(choice);
  if (choice !== state.choice)
    return;
  canvas.width = page.columns;
  canvas.height = page.rows;
  const image = new ImageData(page.columns, page.rows), unit = page.choices[choice].factor;
  for (let i = 0; i < codes.length; ++i) {
    image.data.set(codes[i] === kUndefined ? kNoColour : colourOf(scale.share(codes[i] * unit)), 4 * i);
  }
  canvas.getContext('2d').putImageData(image, 0, 0);
  canvas.setAttribute('aria-label', `Map of CIEDE2000 under ${choices[choice].choice}, at most ` +
    difference(choices[choice].delta_e_max));
  canvas.dataset.choice = choices[choice].choice;
  canvas.dataset.largest = codes.reduce((a, b) => b !== kUndefined && b > a ? b : a, 0) * unit;
  const stops = kViridis.map(c => `rgb(${c})`).join(', ');
  byId('legend').replaceChildren(make('div', {class: 'bar', style: `background: linear-gradient(90deg, ${stops})`}),
    ...scale.ticks.map(([d, label]) => {
      const at = Math.max(scale.share(d), 0);
      return make('span', {class: `tick${at < 0.03 ? ' first' : at > 0.97 ? ' last' : ''}`, style: `left: ${100 * at}%`}, label);
    }));
}

const referenceIndex = choices.findIndex(c => c.choice === 'reference');
const pictureOf = choice => page.pictures[page.choices[choice].picture];

function drawPicture() {
  const shown = state.flipped ? referenceIndex : state.choice, name = choices[shown].choice, picture = byId('picture');
  picture.src = pictureOf(shown);
  picture.alt = `The image under ${name}`;
  picture.dataset.choice = name;
  byId('choice-caption').textContent = name;
  byId('flip').setAttribute('aria-pressed', state.flipped);
}

const count = (n, one, many) => n === 1 ? `one ${one}` : `${n} ${many}`;

function drawNotes() {
  const squares = page.columns * page.rows, side = page.side, clipped = page.choices[state.choice].clipped;
  const what = side === 1 ? 'every pixel' : `the mean light of squares of ${side}x${side} pixels`;
  byId('picture-note').textContent = `Pictures show ${what} (${page.columns}x${page.rows}, 480 a side at most) as linear ` +
    'Rec.709 with the sRGB curve, in 8 bits, white as of the CIEDE2000; ' +
    (clipped ? `${count(clipped, 'square', 'squares')} of ${squares} under this choice lie outside what that holds and are clipped`
             : 'none of this choice is clipped') +
    '. The map has the largest CIEDE2000 of the pixels of each square, rounded up by less than ' +
    `${page.choices[state.choice].factor.toPrecision(1)}; grey has no colour.` +
    (stretched ? ' The image is drawn stretched.' : '');
}
