// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// What the program put into the page, and the arrays packed in it.

const flexneck = {};

flexneck.data = JSON.parse(document.getElementById('data').textContent);

/** The bytes of a base64 text as an array of the given type, such as Float32Array. */
flexneck.unpack = (text, ArrayType) => {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  return new ArrayType(bytes.buffer);
};

/** A number with as many digits as one reads off a curve. */
flexneck.digits = (value) => {
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-4) return value.toExponential(3).replace('-', '−');
  const decimals = Math.max(0, 3 - Math.floor(Math.log10(size)));
  return value.toFixed(Math.min(decimals, 6)).replace('-', '−');
};

/** An element with attributes and children; texts become text nodes, never HTML. */
flexneck.element = (name, attributes = {}, ...children) => {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
};
