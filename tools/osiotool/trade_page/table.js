// SPDX-License-Identifier: Apache-2.0
function drawTable() {
  choices.forEach((c, index) => {
    const cells = [c.bands, seconds(c.seconds), `${seconds(c.fastest)}–${seconds(c.slowest)}`, seconds(c.predicted), c.against_exact,
      seconds(c.decode), seconds(c.collapse), seconds(c.write), megabytes(c.bytes_read), megabytes(c.bytes_written),
      c.peak_mb ? c.peak_mb.toFixed(0) : '–', difference(c.delta_e_mean), difference(c.delta_e_95),
      difference(c.delta_e_99_9), difference(c.delta_e_max), c.largest_xyz === 0 ? '0' : c.largest_xyz.toExponential(1)];
    const row = make('tr', {title: c.meaning},
      make('td', {}, c.front ? make('span', {title: 'on the Pareto front'}, '●') : ''),
      make('th', {scope: 'row'}, make('button', {type: 'button'}, c.choice)),
      ...cells.map(text => make('td', {}, String(text))));
    row.addEventListener('click', () => choose(index));
    row.addEventListener('pointerenter', () => pointAt(index));
    row.addEventListener('pointerleave', () => pointAt(null));
    byId('table').tBodies[0].append(row);
  });
  const undefinedPixels = choices[0].undefined_pixels;
  byId('table-note').textContent = '● on the Pareto front of seconds and largest CIEDE2000: no other choice is both ' +
    'surely faster and as near. predicted: before the runs, from strips of the image. “same”: the runs overlap with those of exact. decode, collapse and write are shares of ' +
    'the run in the middle; MB are 10⁶ bytes, peak is that of resident memory.' +
    (undefinedPixels ? ` ${undefinedPixels} pixels have no colour (NaN or infinite) and enter no difference.` : '');
}
