// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// Two systems of units for the whole page: US customary, and SI with mm, deg, ms, kN and g.

flexneck.units = (() => {
  const table = flexneck.data.units;
  const listeners = [];
  let system = 'customary';
  return {
    /** {name, factor} of what a unit is shown as; `own` goes before the page's table. */
    of: (unit, own = {}) => (own[unit] || table[unit])?.[system] || {name: unit, factor: 1},
    /** Called now, and whenever the reader has chosen. */
    follow: (listener) => {
      listeners.push(listener);
      listener();
    },
    choose: (chosen) => {
      system = chosen;
      for (const listener of listeners) listener();
    },
  };
})();

/** Every number of a text times a factor, to the step that its last decimal has there. */
flexneck.converted = (text, factor) => factor === 1 ? text : text.replace(
    /([+−-]?)(\d+(?:\.(\d+))?(?:e[+-]?\d+)?)/gi, (_, sign, number, fraction = '') => {
      const value = Number(number) * factor;
      if (/e/i.test(number)) return sign + value.toPrecision(4);
      const decimals = Math.ceil(fraction.length - Math.log10(factor));
      return sign + value.toFixed(Math.min(Math.max(0, decimals), 12));
    });

(() => {
  const {units, converted} = flexneck;

  /** Of a table: its numbers by the unit of their column, or by the one that their row names. */
  const show = (table) => {
    const heads = [...table.tHead.rows[0].cells];
    const naming = heads.findIndex((head) => 'namesUnit' in head.dataset);
    const original = (cell) => cell.dataset.given || (cell.dataset.given = cell.textContent);
    heads.forEach((head, column) => {
      const {unit} = head.dataset;
      if (!unit) return;
      const label = head.querySelector('.unit');
      if (label) label.textContent = units.of(unit).name;
      for (const row of table.tBodies[0].rows) {
        const cell = row.cells[column];
        const {factor} = units.of(unit === 'row' ? original(row.cells[naming]) : unit);
        if (cell && column > 0) cell.textContent = converted(original(cell), factor);
      }
    });
    if (naming < 0) return;
    for (const row of table.tBodies[0].rows) {
      const cell = row.cells[naming];
      const given = original(cell);
      cell.textContent = units.of(given).name;
    }
  };

  /** An input stays as it was given, with what it is in the units chosen beside it. */
  const showInput = (cell) => {
    const given = cell.dataset.given || (cell.dataset.given = cell.textContent);
    let isOther = false;
    const other = given.replace(/([+-]?[\d.]+(?:e[+-]?\d+)?) ([A-Za-z][\w*/^]*)/g, (all, number, unit) => {
      const {name, factor} = units.of(unit);
      if (factor === 1) return all;
      isOther = true;
      return `${Number((Number(number) * factor).toPrecision(5))} ${name}`;
    });
    cell.textContent = isOther ? `${given} (${other})` : given;
  };

  units.follow(() => {
    for (const table of document.querySelectorAll('table')) {
      if (table.tHead?.querySelector('[data-unit]')) show(table);
    }
    for (const cell of document.querySelectorAll('[data-table=parameters] td:nth-child(2)')) showInput(cell);
  });
  document.getElementById('units')?.addEventListener(
      'change', (event) => units.choose(event.target.value));
})();
