// SPDX-License-Identifier: Apache-2.0
'use strict';

const trade = JSON.parse(document.getElementById('trade').textContent);
const page = trade.page, spectra = page.spectra, choices = trade.choices;
const byId = id => document.getElementById(id);
const state = {choice: 0, measure: 'delta_e_max', scale: 'common', flipped: false, column: null, row: null};

// Numbers as the tool's own table has them.
const seconds = value => value.toFixed(3);
const megabytes = value => (value / 1e6).toFixed(1);
const difference = value => value === 0 ? '0' : value < 0.0005 ? value.toExponential(0) : value.toFixed(3);
const digits = value => String(Number(value.toPrecision(4)));

function make(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  return fill(element, attributes, children);
}

function draw(name, attributes = {}, ...children) {
  return fill(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);
}

function fill(element, attributes, children) {
  for (const [key, value] of Object.entries(attributes))
    element.setAttribute(key, value);
  element.append(...children);
  return element;
}

// Streams: base64 of zlib of two-byte codes, the high bytes of all first.

async function codesOf(text) {
  const packed = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = bytes.length / 2, codes = new Uint16Array(count);
  for (let i = 0; i < count; ++i)
    codes[i] = bytes[i] << 8 | bytes[count + i];
  return codes;
}

// IEEE 754 binary16.
function half(bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, mantissa = bits & 1023;
  if (exponent === 31)
    return mantissa ? NaN : sign * Infinity;
  return sign * (exponent ? (1024 + mantissa) * 2 ** (exponent - 25) : mantissa * 2 ** -24);
}

const kUndefined = 65535;
const maps = choices.map(() => null);
const mapOf = choice => maps[choice] ??= codesOf(page.choices[choice].codes);
const spectraCodes = codesOf(spectra.codes);
