// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// Turns a camera about a point by mouse, touch, keyboard and buttons.

/**
 * @param canvas  that is dragged on; it takes the keyboard when it has the focus
 * @param home    {target, distance, azimuth, elevation}: metres and radians, z upwards
 * @param changed called when the camera has moved
 */
flexneck.Orbit = class {
  constructor(canvas, camera, home, changed) {
    this.camera = camera;
    this.changed = changed;
    this.pointers = new Map();
    this.setHome(home);
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    canvas.addEventListener('pointermove', (event) => this.drag(event, canvas));
    for (const end of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    }
    canvas.addEventListener('wheel', (event) => {
      if (!event.ctrlKey) return;  // the page scrolls
      event.preventDefault();
      this.turn(0, 0, Math.exp(event.deltaY / 500));
    }, {passive: false});
    canvas.addEventListener('keydown', (event) => {
      const step = flexneck.Orbit.keys[event.key];
      if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      this.step(step);
    });
  }

  /** A new subject: the camera goes there. */
  setHome(home) {
    this.home = home;
    this.step('home');
  }

  step(name) {
    const [azimuth, elevation, distance] = flexneck.Orbit.steps[name] || [];
    if (name === 'home') Object.assign(this, this.home);
    this.turn(azimuth || 0, elevation || 0, distance || 1);
  }

  drag(event, canvas) {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const after = [event.clientX, event.clientY];
    const other = [...this.pointers].find(([id]) => id !== event.pointerId);
    this.pointers.set(event.pointerId, after);
    if (other) {  // two fingers
      const length = (point) => Math.hypot(point[0] - other[1][0], point[1] - other[1][1]);
      this.turn(0, 0, length(before) / Math.max(length(after), 1));
    } else {
      const radians = Math.PI / canvas.clientHeight;
      this.turn((before[0] - after[0]) * radians, (after[1] - before[1]) * radians, 1);
    }
  }

  turn(azimuth, elevation, distance) {
    const steepest = Math.PI / 2 - 0.01;
    this.azimuth += azimuth;
    this.elevation = Math.max(-steepest, Math.min(steepest, this.elevation + elevation));
    this.distance = Math.max(0.3 * this.home.distance,
                             Math.min(4 * this.home.distance, this.distance * distance));
    const across = this.distance * Math.cos(this.elevation);
    this.camera.position.set(this.target.x + across * Math.cos(this.azimuth),
                             this.target.y + across * Math.sin(this.azimuth),
                             this.target.z + this.distance * Math.sin(this.elevation));
    this.camera.lookAt(this.target);
    this.changed();
  }
};

/** Azimuth and elevation by radians, distance by a factor. */
flexneck.Orbit.steps = {
  left: [-0.2, 0, 1], right: [0.2, 0, 1], up: [0, 0.2, 1], down: [0, -0.2, 1],
  near: [0, 0, 0.85], far: [0, 0, 1 / 0.85],
};

flexneck.Orbit.keys = {
  ArrowLeft: 'left', ArrowRight: 'right', ArrowUp: 'up', ArrowDown: 'down',
  '+': 'near', '=': 'near', '-': 'far', Home: 'home',
};
