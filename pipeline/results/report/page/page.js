// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// Tables that can be searched and saved, the list of inputs by origin, pictures that can be saved.

(() => {
  const {element, csv, fileName, save, saveButtons} = flexneck;
  const kLong = 12;  // rows from which on one searches

  for (const table of document.querySelectorAll('table[data-table]')) {
    const title = table.caption.textContent;
    const rows = [...table.tBodies[0].rows];
    const texts = () => [table.tHead.rows[0], ...rows.filter((row) => row.style.display !== 'none')]
        .map((row) => [...row.cells].map((cell) => cell.textContent.trim()));
    const bar = element('div', {class: 'controls tools'});
    if (rows.length >= kLong) {
      const count = element('output', {class: 'note'});
      const field = element('input', {type: 'search', 'aria-label': `Search: ${title}`, placeholder: 'Search'});
      field.addEventListener('input', () => {
        const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
        let shown = 0;
        for (const row of rows) {
          const text = row.textContent.toLowerCase();
          const isFound = words.every((word) => text.includes(word));
          row.style.display = isFound ? '' : 'none';
          shown += isFound && !row.hidden;
        }
        count.textContent = words.length > 0 ? `${shown} of ${rows.length}` : '';
      });
      bar.append(field, count);
    }
    bar.append(saveButtons(title, {
      CSV: () => save(`${fileName(table.dataset.table)}.csv`, csv(texts()), 'text/csv'),
    }));
    table.closest('.table').before(bar);
  }

  const group = document.getElementById('origins');
  const inputs = [...document.querySelectorAll('[data-table=parameters] tbody tr')];
  group?.addEventListener('click', (event) => {
    const button = event.target.closest('button');
    if (!button) return;
    const isShown = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', isShown);
    for (const row of inputs) {
      if (row.dataset.origin === button.dataset.origin) row.hidden = !isShown;
    }
  });

  const prefix = 'data:image/svg+xml;base64,';
  for (const image of document.querySelectorAll(`figure img[src^="${prefix}"]`)) {
    const bytes = () => Uint8Array.from(
        atob(image.src.slice(prefix.length)), (character) => character.charCodeAt(0));
    const text = () => new TextDecoder().decode(bytes());
    const figure = image.closest('figure');
    const name = figure.id || fileName(image.alt);
    const actions = {
      SVG: () => flexneck.saveSvg(name, text()),
      PNG: () => flexneck.savePng(name, text()),
    };
    const data = figure.querySelector('script[type="text/csv"]');
    if (data) actions.CSV = () => save(`${name}.csv`, data.textContent.trimStart(), 'text/csv');
    figure.append(saveButtons(image.alt, actions));
  }
})();
