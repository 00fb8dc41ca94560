// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// What a reader takes out of the page: pictures as SVG or PNG, curves and tables as CSV.

/** Hands a file to the browser. */
flexneck.save = (name, content, type) => {
  const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], {type}));
  flexneck.element('a', {href: url, download: name}).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
};

flexneck.saveSvg = (name, text) => flexneck.save(`${name}.svg`, text, 'image/svg+xml');

/** Drawn at twice its size or more, for print. */
flexneck.savePng = (name, text) => {
  const image = new Image();
  image.addEventListener('load', () => {
    const scale = Math.max(2, 1280 / image.width);
    const canvas = flexneck.element('canvas', {width: scale * image.width, height: scale * image.height});
    canvas.getContext('2d').drawImage(image, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => flexneck.save(`${name}.png`, blob));
  });
  image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(text)}`;
};

/** Rows of texts and numbers as CSV; texts in quotes where they need them. */
flexneck.csv = (rows) => rows.map((row) => row.map((cell) => {
  const text = String(cell ?? '');
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}).join(',')).join('\n') + '\n';

/** A name for a file from a text for people. */
flexneck.fileName = (text) => text.trim().replace(/[^\w.-]+/g, '-').replace(/^-|-$/g, '').toLowerCase();

/** Buttons that save, each with its word and what it does. */
flexneck.saveButtons = (what, actions) => {
  const buttons = Object.entries(actions).map(([word, act]) => {
    const button = flexneck.element(
        'button', {type: 'button', 'data-save': word.toLowerCase(), 'aria-label': `Save ${what} as ${word}`}, word);
    button.addEventListener('click', act);
    return button;
  });
  return flexneck.element('span', {class: 'save', role: 'group', 'aria-label': `Save ${what}`}, ...buttons);
};

/** A drawing of ours as a file of its own: what the page's style says stands in it, lines below it. */
flexneck.standaloneSvg = (svg, lines) => {
  const width = svg.clientWidth;
  const below = svg.clientHeight;
  const copy = svg.cloneNode(true);
  const properties = ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'opacity', 'font-size', 'font-family',
                      'display'];
  const originals = svg.querySelectorAll('*');
  copy.querySelectorAll('*').forEach((element, k) => {
    const style = getComputedStyle(originals[k]);
    for (const property of properties) element.setAttribute(property, style.getPropertyValue(property));
  });
  const page = getComputedStyle(document.body);
  const add = (name, attributes, text = '') => {
    const element = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.textContent = text;
    return element;
  };
  const height = below + 20 * lines.length + 8;
  copy.prepend(add('rect', {width, height, fill: page.backgroundColor}));
  lines.forEach(({name, stroke, width: thickness, dash}, k) => {
    const y = below + 20 * k + 8;
    copy.append(
        add('line', {x1: 78, x2: 138, y1: y, y2: y, stroke, 'stroke-width': thickness, 'stroke-dasharray': dash}),
        add('text', {x: 146, y: y + 4, fill: page.color, 'font-size': 13, 'font-family': 'sans-serif'}, name));
  });
  for (const [key, value] of Object.entries({xmlns: 'http://www.w3.org/2000/svg', width, height,
                                             viewBox: `0 0 ${width} ${height}`})) {
    copy.setAttribute(key, value);
  }
  return new XMLSerializer().serializeToString(copy);
};
