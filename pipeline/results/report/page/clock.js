// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// The clock of the scene: its slider with ticks, its speed, play and pause.

flexneck.Clock = class {
  /** @param control  by name, of the scene; @param changed  called when the time has changed */
  constructor(control, changed) {
    Object.assign(this, {control, changed, isPlaying: false, slider: control('clock')});
    this.slider.addEventListener('input', () => {
      this.play(false);
      changed();
    });
    control('play').addEventListener('click', () => this.play(!this.isPlaying));
  }

  /** Seconds of a run, or the phase of a mode from 0 to 1. */
  get time() { return Number(this.slider.value); }

  /** For a source, or for two of a kind. */
  use(source, duration) {
    const isMode = source.kind === 'mode';
    Object.assign(this, {duration, isMode});
    this.slider.max = duration;
    this.slider.value = Math.min(source.start, duration);
    this.control('clock-name').textContent = isMode ? 'Phase' : 'Time (ms)';
    if (this.kind !== source.kind) this.offerSpeeds(source.kind);
    this.kind = source.kind;
    const texts = isMode ? [0, 90, 180, 270, 360].map((angle) => [angle / 360, `${angle}°`])
        : flexneck.ticks(1000 * duration, 6).map((time) => [time / 1000, `${time}`]);
    this.control('ticks').replaceChildren(...texts.map(([time, text]) => {
      const tick = flexneck.element('span', {}, text);
      tick.style.left = `${100 * time / duration}%`;
      return tick;
    }));
  }

  offerSpeeds(kind) {
    const speeds = kind === 'mode' ? [[0.2, '5 s per cycle'], [0.4, '2.5 s per cycle'], [1, '1 s per cycle']]
        : [[0.01, '1/100'], [0.02, '1/50'], [0.05, '1/20'], [0.1, '1/10'], [0.25, '1/4'], [0.5, '1/2'], [1, 'real time']];
    const usual = {mode: 0.4, pendulum: 0.1}[kind] || 0.5;
    this.control('speed').replaceChildren(...speeds.map(([speed, text]) => {
      const option = flexneck.element('option', {value: speed}, text);
      option.selected = speed === usual;
      return option;
    }));
  }

  play(start) {
    this.isPlaying = start;
    this.control('play').setAttribute('aria-pressed', start);
    this.control('play').textContent = start ? 'Pause' : 'Play';
  }

  /** Some seconds of the reader's have passed. */
  pass(elapsed) {
    if (!this.isPlaying) return;
    const next = this.time + elapsed * Number(this.control('speed').value);
    this.slider.value = next % this.duration;
    this.changed();
  }

  text() { return this.isMode ? `${Math.round(360 * this.time)}°` : `${(1000 * this.time).toFixed(1)} ms`; }
};

/** Round numbers from 0 to a limit, about so many. */
flexneck.ticks = (limit, count) => {
  const power = 10 ** Math.floor(Math.log10(limit / count));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((each) => limit / each <= count);
  return Array.from({length: Math.floor(limit / step + 1e-6) + 1}, (_, k) => Number((k * step).toPrecision(6)));
};
