// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// A neck of one folder of results: its surface, and what it can be shown doing, modes and runs.

flexneck.Body = class {
  /** @param label of its folder; empty on a page of one folder */
  constructor(data, label) {
    const {unpack} = flexneck;
    this.data = data;
    this.positions = unpack(data.surface.positions, Float32Array);
    this.shapes = data.modes.map(({shape}) => {
      const values = Float32Array.from(unpack(shape.values, Int16Array));
      return values.map((value) => value * shape.scale);
    });
    const extent = [0, 1, 2].map((axis) => {
      let [low, high] = [Infinity, -Infinity];
      for (let i = axis; i < this.positions.length; i += 3) {
        low = Math.min(low, this.positions[i]);
        high = Math.max(high, this.positions[i]);
      }
      return {low, high};
    });
    this.length = Math.max(...extent.map(({low, high}) => high - low));
    this.centre = new THREE.Vector3(...extent.map(({low, high}) => (low + high) / 2));
    const prefix = label ? `${label}: ` : '';
    this.sources = [...data.modes.map((mode, k) => this.modeSource(mode, k)),
                    ...data.motions.map((motion) => this.motionSource(motion))];
    for (const source of this.sources) Object.assign(source, {body: this, label: prefix + source.label});
  }

  /** Displacements of all vertices for coordinates of some modes. */
  displaced(places, coordinates) {
    const sum = new Float32Array(this.positions.length);
    places.forEach((place, k) => {
      const shape = this.shapes[place];
      const factor = coordinates[k];
      for (let i = 0; i < sum.length; ++i) sum[i] += factor * shape[i];
    });
    return sum;
  }

  /** Displacements of all vertices where rigid plates carry them, in the rubber evenly from one to
   * the next. */
  carried(sections, shares, plates) {
    const {positions} = this;
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
  }

  /** A mode swings; the clock is the phase, 0 to 1. */
  modeSource(mode, k) {
    const most = flexneck.largest(this.shapes[k]);
    return {
      label: `Mode ${k + 1}: ${mode.name}, ${mode.frequencyHz.toFixed(2)} Hz`,
      name: mode.name,
      kind: 'mode',
      duration: 1,
      start: 0.25,
      home: {target: this.centre, distance: 2.9 * this.length, azimuth: -0.9, elevation: 0.28},
      width: 1.1 * this.length,
      notes: ['The size of a mode is arbitrary.'],
      most: () => null,
      /** At a clock, with the size and the largest displacement that the reader chose. */
      draw: (actor, clock, {size}) => {
        const amplitude = 0.3 * this.length * size / most;
        const sway = Math.sin(2 * Math.PI * clock);
        // Of this moment: a mode keeps its colours as it swings.
        actor.show(this.displaced([k], [amplitude * sway]), amplitude * most * Math.abs(sway));
      },
    };
  }

  motionSource(motion) {
    const {unpack, largest} = flexneck;
    const times = unpack(motion.times, Float32Array);
    const [base, arm, head] = ['base', 'arm', 'head'].map(
        (part) => motion[part] && unpack(motion[part], Float32Array));
    const rows = unpack(motion.plates || motion.coordinates, Float32Array);
    const count = rows.length / times.length;
    const at = (frame) => rows.subarray(count * frame, count * frame + count);
    const sections = motion.plates && unpack(motion.sections, Uint8Array);
    const shares = motion.plates && unpack(motion.shares, Float32Array);
    const loads = (motion.loads || []).map((load) => unpack(load.rows, Float32Array));
    const strongest = Math.max(0, ...loads.map((load) => {
      let most = 0;
      for (let i = 3; i < load.length; i += 6) most = Math.max(most, Math.hypot(...load.subarray(i, i + 3)));
      return most;
    }));
    const displacements = (frame) => motion.plates
        ? this.carried(sections, shares, at(frame)) : this.displaced(motion.modes, at(frame));
    let most = null;
    const findMost = () => {
      for (let frame = 0; frame < times.length; ++frame) most = Math.max(most, largest(displacements(frame)));
      return most;
    };
    const isPendulum = motion.kind === 'pendulum';
    const middle = Math.floor(times.length / 2);
    const hangs = base[7 * middle + 3] ** 2 + base[7 * middle + 6] ** 2 < 0.5;
    const duration = times[times.length - 1];
    const start = isPendulum ? Math.min(0.06, duration) : duration;
    const frameAt = (clock) => {
      const frame = times.findIndex((time) => time >= clock);
      return frame < 0 ? times.length - 1 : frame;
    };
    const target = new THREE.Vector3(...base.subarray(7 * middle, 7 * middle + 3));
    target.z += (hangs ? -1 : 1) * 0.75 * this.length;
    const loadAt = (frame) => loads.map((load) => load.subarray(6 * frame, 6 * frame + 6));
    return {
      label: `${isPendulum ? 'Pendulum' : 'Static test'}: ${motion.name}`,
      name: motion.name,
      kind: motion.kind,
      duration,
      start,
      home: {target, distance: 6.2 * this.length, elevation: 0.12,
             azimuth: flexneck.isLateral(displacements(frameAt(start))) ||
                 /lateral/.test(motion.name) ? 0 : -Math.PI / 2},
      width: 2.4 * this.length,
      notes: [motion.plates && 'The surface is interpolated between the plates; slits are not drawn.',
              motion.coordinates === '' && 'The neck is rigid; the undeformed neck is drawn.',
              isPendulum && 'Only the end of the arm is drawn; the head is the ellipsoid of its mass and inertia, with a dot at its centre.',
              loads.length > 0 && 'The arrow is the load; its length is proportional to it.',
      ].filter(Boolean),
      /** Looked for when it is first shown: it takes a while. */
      most: () => most ?? findMost(),
      load: (clock) => loadAt(frameAt(clock)).reduce((sum, row) => sum + Math.hypot(...row.subarray(3)), 0),
      hasLoad: loads.length > 0,
      draw: (actor, clock, {most: shown}) => {
        const frame = frameAt(clock);
        actor.show(displacements(frame), shown);
        actor.place('neck', base, frame);
        actor.place('arm', arm || base, frame);
        if (head) actor.place('head', head, frame);
        actor.drawLoads(loadAt(frame), strongest);
      },
      hasHead: Boolean(head),
    };
  }
};

flexneck.largest = (vectors) => {
  let most = 0;
  for (let i = 0; i < vectors.length; i += 3) {
    most = Math.max(most, Math.hypot(vectors[i], vectors[i + 1], vectors[i + 2]));
  }
  return most;
};

/** Whether displacements go to the side rather than fore and aft. */
flexneck.isLateral = (vectors) => {
  const sum = [0, 0, 0];
  for (let i = 0; i < vectors.length; ++i) sum[i % 3] += Math.abs(vectors[i]);
  return sum[1] > sum[0];
};
