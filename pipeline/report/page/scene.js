// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// The neck in three dimensions: its modes, and its motion with the head in the experiments.

flexneck.startScene = (data, canvas) => {
  const control = (name) => document.getElementById(`scene-${name}`);
  const {unpack} = flexneck;

  const positions = unpack(data.surface.positions, Float32Array);
  const shapes = data.modes.map(({shape}) => {
    const values = Float32Array.from(unpack(shape.values, Int16Array));
    return values.map((value) => value * shape.scale);
  });
  const extent = [0, 1, 2].map((axis) => {
    let [low, high] = [Infinity, -Infinity];
    for (let i = axis; i < positions.length; i += 3) {
      low = Math.min(low, positions[i]);
      high = Math.max(high, positions[i]);
    }
    return {low, high};
  });
  const length = Math.max(...extent.map(({low, high}) => high - low));

  // --- displacement -------------------------------------------------------------------------------

  /** Displacements of all vertices for coordinates of some modes. */
  const displaced = (places, coordinates) => {
    const sum = new Float32Array(positions.length);
    places.forEach((place, k) => {
      const shape = shapes[place];
      const factor = coordinates[k];
      for (let i = 0; i < sum.length; ++i) sum[i] += factor * shape[i];
    });
    return sum;
  };

  /** Displacements of all vertices where rigid plates carry them, in the rubber evenly from one to
   * the next. */
  const carried = (sections, shares, plates) => {
    const sum = new Float32Array(positions.length);
    const of = (plate, i, axis) => {
      const row = 12 * plate + 3 * axis;
      return plates[row] * positions[i] + plates[row + 1] * positions[i + 1] +
          plates[row + 2] * positions[i + 2] + plates[12 * plate + 9 + axis];
    };
    for (let vertex = 0; vertex < sections.length; ++vertex) {
      const i = 3 * vertex;
      const share = shares[vertex];
      for (let axis = 0; axis < 3; ++axis) {
        sum[i + axis] = (1 - share) * of(sections[vertex], i, axis) +
            share * of(sections[vertex] + 1, i, axis) - positions[i + axis];
      }
    }
    return sum;
  };

  const largest = (vectors) => {
    let most = 0;
    for (let i = 0; i < vectors.length; i += 3) {
      most = Math.max(most, Math.hypot(vectors[i], vectors[i + 1], vectors[i + 2]));
    }
    return most;
  };

  /** Whether displacements go to the side rather than fore and aft. */
  const isLateral = (vectors) => {
    const sum = [0, 0, 0];
    for (let i = 0; i < vectors.length; ++i) sum[i % 3] += Math.abs(vectors[i]);
    return sum[1] > sum[0];
  };

  // --- colours ------------------------------------------------------------------------------------

  /** Red, green and blue from 0 to 1 along the scale. */
  const ramp = data.scale.map(
      (colour) => [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16) / 255));
  control('ramp').style.background = `linear-gradient(to top, ${data.scale.join(', ')})`;
  const paint = (share, target, at) => {
    const place = Math.min(Math.max(share, 0), 1) * (ramp.length - 1);
    const below = Math.min(Math.floor(place), ramp.length - 2);
    for (let part = 0; part < 3; ++part) {
      target[at + part] =
          ramp[below][part] + (place - below) * (ramp[below + 1][part] - ramp[below][part]);
    }
  };

  const stage = flexneck.makeStage(data, positions, length, canvas);
  if (!stage) {
    canvas.replaceWith(flexneck.element(
        'p', {class: 'warning'}, 'This browser has no WebGL, so the neck cannot be shown here.'));
    return;
  }
  const {renderer, camera, neck, edges, ghost, arm, head, moved, colours} = stage;

  // --- sources: modes and motions -----------------------------------------------------------------

  const show = (displacement, most) => {
    for (let i = 0; i < displacement.length; i += 3) {
      for (let axis = 0; axis < 3; ++axis) {
        moved.array[i + axis] = positions[i + axis] + displacement[i + axis];
      }
      const size = Math.hypot(displacement[i], displacement[i + 1], displacement[i + 2]);
      paint(most > 0 ? size / most : 0, colours.array, i);
    }
    moved.needsUpdate = true;
    colours.needsUpdate = true;
  };

  const place = (group, poses, frame) => {
    const [x, y, z, qw, qx, qy, qz] = poses.subarray(7 * frame, 7 * frame + 7);
    group.position.set(x, y, z);
    group.quaternion.set(qx, qy, qz, qw);
  };

  const centre = new THREE.Vector3(...extent.map(({low, high}) => (low + high) / 2));

  /** A mode swings; the clock is the phase, 0 to 1. */
  const modeSource = (mode, k) => {
    const most = largest(shapes[k]);
    return {
      label: `Mode ${k + 1}: ${mode.name}, ${mode.frequencyHz.toFixed(2)} Hz`,
      isMode: true,
      duration: 1, seconds: 2.5, start: 0.25,
      home: {target: centre, distance: 2.9 * length, azimuth: -0.9, elevation: 0.28},
      note: 'The size of a mode is arbitrary.',
      most: '1',
      draw(clock) {
        const amplitude = 0.3 * length * Number(control('size').value) / most;
        const sway = Math.sin(2 * Math.PI * clock);
        // Of this moment: a mode keeps its colours as it swings.
        show(displaced([k], [amplitude * sway]), amplitude * most * Math.abs(sway));
        return `${Math.round(360 * clock)}°`;
      },
    };
  };

  /** A run plays ten times slower than it was, a static test in real time. */
  const motionSource = (motion) => {
    const times = unpack(motion.times, Float32Array);
    const base = unpack(motion.base, Float32Array);
    const headPoses = motion.head && unpack(motion.head, Float32Array);
    const rows = unpack(motion.plates || motion.coordinates, Float32Array);
    const count = rows.length / times.length;
    const at = (frame) => rows.subarray(count * frame, count * frame + count);
    const sections = motion.plates && unpack(motion.sections, Uint8Array);
    const shares = motion.plates && unpack(motion.shares, Float32Array);
    const displacements = (frame) => motion.plates
        ? carried(sections, shares, at(frame)) : displaced(motion.modes, at(frame));
    let most = null;
    const findMost = () => {
      for (let frame = 0; frame < times.length; ++frame) {
        most = Math.max(most, largest(displacements(frame)));
      }
      return most;
    };
    const isPendulum = motion.kind === 'pendulum';
    const duration = times[times.length - 1];
    const middle = Math.floor(times.length / 2);
    const hangs = base[7 * middle + 3] ** 2 + base[7 * middle + 6] ** 2 < 0.5;
    const start = isPendulum ? Math.min(0.06, duration) : duration;
    const startFrame = times.findIndex((time) => time >= start);
    const target = new THREE.Vector3(...base.subarray(7 * middle, 7 * middle + 3));
    target.z += (hangs ? -1 : 1) * 0.75 * length;
    return {
      label: `${isPendulum ? 'Pendulum' : 'Static test'}: ${motion.name}`,
      duration, seconds: isPendulum ? 10 * duration : 2 * duration,
      start,
      home: {target, distance: 6.2 * length, elevation: 0.12,
             azimuth: isLateral(displacements(startFrame)) ? 0 : -Math.PI / 2},
      note: (motion.plates ? 'Rigid plates; slits are not drawn. ' : '') + (isPendulum
          ? 'The pendulum plays at a tenth of its speed. Of the arm only the end is drawn; the head is the ellipsoid of its mass and inertia, its centre a dot.'
          : ''),
      /** Looked for when it is first shown: it takes a while. */
      get most() { return `${(1000 * (most || findMost())).toFixed(0)} mm`; },
      draw(clock) {
        let frame = times.findIndex((time) => time >= clock);
        if (frame < 0) frame = times.length - 1;
        show(displacements(frame), most);
        place(neck, base, frame);
        place(arm, base, frame);
        if (headPoses) place(head, headPoses, frame);
        return `${(1000 * times[frame]).toFixed(1)} ms`;
      },
      hasHead: Boolean(headPoses),
    };
  };

  const sources = [...data.modes.map(modeSource), ...data.motions.map(motionSource)];
  const menus = {Modes: (source) => source.isMode, Experiments: (source) => !source.isMode};
  for (const [label, belongs] of Object.entries(menus)) {
    const group = flexneck.element('optgroup', {label});
    sources.forEach((source, k) => {
      if (belongs(source)) group.append(flexneck.element('option', {value: k}, source.label));
    });
    if (group.children.length > 0) control('source').append(group);
  }

  // --- playing ------------------------------------------------------------------------------------

  let source = sources[0];
  let isPlaying = false;
  let isStale = true;
  const orbit = new flexneck.Orbit(canvas, camera, source.home, () => { isStale = true; });

  const clock = control('clock');
  const redraw = () => {
    control('time').textContent = source.draw(Number(clock.value));
    isStale = true;
  };
  const choose = () => {
    source = sources[Number(control('source').value)];
    clock.max = source.duration;
    clock.value = source.start;
    control('clock-name').textContent = source.isMode ? 'Phase' : 'Time';
    control('size-label').hidden = !source.isMode;
    control('note').textContent = source.note;
    control('most').textContent = source.most;
    ghost.visible = Boolean(source.isMode);
    arm.visible = !source.isMode;
    head.visible = Boolean(source.hasHead);
    neck.position.set(0, 0, 0);
    neck.quaternion.set(0, 0, 0, 1);
    orbit.setHome(source.home);
    redraw();
  };
  const play = (start) => {
    isPlaying = start;
    control('play').setAttribute('aria-pressed', start);
    control('play').textContent = start ? 'Pause' : 'Play';
  };

  control('source').addEventListener('change', choose);
  control('size').addEventListener('input', redraw);
  clock.addEventListener('input', () => { play(false); redraw(); });
  control('play').addEventListener('click', () => play(!isPlaying));
  control('edges').addEventListener('change', (event) => {
    edges.visible = event.target.checked;
    isStale = true;
  });
  control('turn').addEventListener('click', (event) => {
    const button = event.target.closest('button');
    if (button) orbit.step(button.dataset.turn);
  });
  canvas.addEventListener('keydown', (event) => {
    if (event.key !== ' ') return;
    event.preventDefault();
    play(!isPlaying);
  });

  const fit = () => {
    const {clientWidth: width, clientHeight: height} = canvas;
    if (width === 0) return;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.fov = width < height ? 30 * height / width : 30;  // the neck fits the narrower side
    camera.updateProjectionMatrix();
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
    if (isPlaying && isSeen) {
      const next = Number(clock.value) + elapsed * source.duration / source.seconds;
      clock.value = next % source.duration;
      redraw();
    }
    if (isStale && isSeen) {
      isStale = false;
      renderer.render(stage.scene, camera);
      canvas.dataset.drawn = Number(canvas.dataset.drawn || 0) + 1;
    }
    requestAnimationFrame(frame);
  };
  choose();
  fit();
  requestAnimationFrame(frame);
  if (!window.matchMedia('(prefers-reduced-motion: reduce)').matches) play(true);
};

// The page is there to be read before the graphics have started, which takes a while.
window.addEventListener('load', () => {
  const canvas = document.getElementById('scene-canvas');
  if (canvas) setTimeout(() => flexneck.startScene(flexneck.data.scene, canvas), 50);
});
