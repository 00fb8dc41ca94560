// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// The neck in three dimensions: modes and runs, one or two side by side.

flexneck.startScene = (scenes, canvas) => {
  const control = (name) => document.getElementById(`scene-${name}`);
  const {element, units} = flexneck;
  const bodies = scenes.map(({scene, label}) => new flexneck.Body(scene, label));
  const sources = bodies.flatMap((body) => body.sources);
  const stage = flexneck.makeStage(Math.max(...bodies.map((body) => body.length)), canvas);
  if (!stage) {
    flexneck.showPictures(canvas);
    return;
  }
  control('ramp').style.background = `linear-gradient(to top, ${scenes[0].scene.scale.join(', ')})`;

  let isStale = true;
  let drawn = [];  // {source, actor} of what is shown, one or two
  const actors = [new Map(), new Map()];
  const orbit = new flexneck.Orbit(canvas, stage.camera, sources[0].home, () => { isStale = true; });

  const mostShown = () => Math.max(...drawn.map(({source}) => source.most()));
  const redraw = () => {
    const choices = {size: Number(control('size').value), most: drawn[0].source.kind === 'mode' ? 1 : mostShown()};
    for (const {source, actor} of drawn) source.draw(actor, clock.time, choices);
    const force = units.of('N');
    const loads = drawn.filter(({source}) => source.hasLoad).map(
        ({source}) => `${flexneck.digits(source.load(clock.time) * force.factor)} ${force.name}`);
    control('time').textContent = [clock.text(), ...loads].join(', ');
    isStale = true;
  };
  const clock = new flexneck.Clock(control, redraw);

  const label = () => {
    const {name, factor} = units.of('m');
    const isMode = drawn[0].source.kind === 'mode';
    control('scale-title').textContent = isMode ? 'displacement / largest' : `displacement (${name})`;
    control('most').textContent = isMode ? '1' : flexneck.digits(mostShown() * factor);
    redraw();
  };

  /** Beside a source may stand another of its kind. */
  const offerSecond = (first) => {
    const menu = control('second');
    const before = menu.value;
    menu.replaceChildren(element('option', {value: ''}, 'nothing'));
    sources.forEach((source, k) => {
      if (source !== first && source.kind === first.kind) menu.append(element('option', {value: k}, source.label));
    });
    menu.value = before;
    if (menu.selectedIndex < 0) menu.value = '';
  };

  const actorOf = (slot, source) => {
    const known = actors[slot];
    if (!known.has(source.body)) {
      const actor = new flexneck.Actor(source.body);
      stage.scene.add(actor.root);
      known.set(source.body, actor);
    }
    return known.get(source.body);
  };

  const choose = () => {
    const first = sources[Number(control('source').value)];
    offerSecond(first);
    const second = control('second').value && sources[Number(control('second').value)];
    for (const known of actors) for (const actor of known.values()) actor.root.visible = false;
    drawn = [first, second].filter(Boolean).map((source, slot) => ({source, actor: actorOf(slot, source)}));
    const {target, distance, azimuth, elevation} = first.home;
    const spread = second ? (first.width + second.width) / 4 : 0;
    drawn.forEach(({source, actor}, slot) => {
      actor.root.visible = true;
      actor.edges.visible = control('edges').checked;
      actor.reset(source);
      const right = (slot === 0 ? -1 : 1) * spread;  // as the camera sees it
      actor.root.position.copy(target).sub(source.home.target)
          .add(new THREE.Vector3(-Math.sin(azimuth) * right, Math.cos(azimuth) * right, 0));
    });
    clock.use(first, Math.max(...drawn.map(({source}) => source.duration)));
    control('size-label').hidden = first.kind !== 'mode';
    control('note').textContent = [...new Set(drawn.flatMap(({source}) => source.notes))].join(' ') +
        (second ? ` Left: ${first.label}. Right: ${second.label}.` : '');
    const farther = canvas.clientWidth < 1.2 * canvas.clientHeight ? 1.6 : 1.25;  // two fit a phone, too
    orbit.setHome({target, distance: distance * (second ? farther : 1), azimuth, elevation});
    label();
  };

  const menus = {Runs: (source) => source.kind !== 'mode', Modes: (source) => source.kind === 'mode'};
  for (const [title, belongs] of Object.entries(menus)) {
    const group = element('optgroup', {label: title});
    sources.forEach((source, k) => {
      if (belongs(source)) group.append(element('option', {value: k}, source.label));
    });
    if (group.children.length > 0) control('source').append(group);
  }

  // A test of a regulation first: the neck moves far.
  const wanted = sources.findIndex((source) => source.name && source.name === scenes[0].scene.shown);
  if (wanted >= 0) control('source').value = wanted;

  control('source').addEventListener('change', choose);
  control('second').addEventListener('change', choose);
  control('size').addEventListener('input', redraw);
  control('edges').addEventListener('change', (event) => {
    for (const {actor} of drawn) actor.edges.visible = event.target.checked;
    isStale = true;
  });
  control('turn').addEventListener('click', (event) => {
    const button = event.target.closest('button[data-turn]');
    if (button) orbit.step(button.dataset.turn);
  });
  control('turn').append(flexneck.saveButtons('this view', {
    PNG: () => {
      stage.render();
      canvas.toBlob((blob) => flexneck.save(`${flexneck.fileName(drawn[0].source.label)}.png`, blob));
    },
  }));
  canvas.addEventListener('keydown', (event) => {
    if (event.key !== ' ') return;
    event.preventDefault();
    clock.play(!clock.isPlaying);
  });

  const fit = () => {
    const {clientWidth: width, clientHeight: height} = canvas;
    if (width === 0) return;
    stage.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    stage.renderer.setSize(width, height, false);
    stage.camera.aspect = width / height;
    stage.camera.fov = width < height ? 30 * height / width : 30;  // the neck fits the narrower side
    stage.camera.updateProjectionMatrix();
    isStale = true;
  };
  new ResizeObserver(fit).observe(canvas);

  let isSeen = true;
  new IntersectionObserver((entries) => { isSeen = entries[entries.length - 1].isIntersecting; })
      .observe(canvas);

  let before = performance.now();
  const frame = (now) => {
    const elapsed = (now - before) / 1000;
    before = now;
    if (isSeen) clock.pass(elapsed);
    if (isStale && isSeen) {
      isStale = false;
      stage.render();
      canvas.dataset.drawn = Number(canvas.dataset.drawn || 0) + 1;
    }
    requestAnimationFrame(frame);
  };
  choose();
  if (bodies.length > 1) flexneck.showBeside(sources, bodies, control, choose);
  units.follow(label);
  fit();
  requestAnimationFrame(frame);
  if (!window.matchMedia('(prefers-reduced-motion: reduce)').matches) clock.play(true);
};

/** Of several folders the first shows a run, or a mode, beside the same of another: what it shows by itself if another
 * has it, else its first that another has. */
flexneck.showBeside = (sources, bodies, control, choose) => {
  const shown = sources[Number(control('source').value)];
  const sameOf = (source) => bodies.filter((body) => body !== source.body).flatMap((body) => body.sources)
      .find((other) => other.kind === source.kind && other.name === source.name);
  const first = [shown, ...shown.body.sources.filter(({kind}) => kind === shown.kind), ...shown.body.sources].find(sameOf);
  if (!first) return;
  control('source').value = sources.indexOf(first);
  choose();  // offers what may stand beside it
  control('second').value = sources.indexOf(sameOf(first));
  choose();
};

/** Without WebGL pictures of the neck stand in, as far as the page has any. */
flexneck.showPictures = (canvas) => {
  const {element} = flexneck;
  const viewer = canvas.closest('.viewer');
  const figures = [...document.querySelectorAll('figure[data-shows=neck]')].map((figure) => {
    const copy = figure.cloneNode(true);
    copy.removeAttribute('id');
    copy.querySelectorAll('.save, script').forEach((each) => each.remove());
    copy.querySelector('img').loading = 'eager';
    return copy;
  });
  viewer.replaceChildren(
      element('p', {class: 'warning'}, figures.length > 0
          ? 'This browser has no WebGL: pictures are shown instead of the moving neck.'
          : 'This browser has no WebGL, so the neck cannot be shown here.'),
      element('div', {class: 'figures stand-in'}, ...figures));
};

// The page is there to be read before the graphics have started, which takes a while.
window.addEventListener('load', () => {
  const canvas = document.getElementById('scene-canvas');
  if (canvas) setTimeout(() => flexneck.startScene(flexneck.data.scenes, canvas), 50);
});
