// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// The list of inputs: which origins are shown.

(() => {
  const group = document.getElementById('origins');
  if (!group) return;
  const rows = [...document.querySelectorAll('[data-table=parameters] tbody tr')];
  group.addEventListener('click', (event) => {
    const button = event.target.closest('button');
    if (!button) return;
    const isShown = button.getAttribute('aria-pressed') !== 'true';
    button.setAttribute('aria-pressed', isShown);
    for (const row of rows) {
      if (row.dataset.origin === button.dataset.origin) row.hidden = !isShown;
    }
  });
})();
