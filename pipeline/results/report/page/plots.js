// SPDX-License-Identifier: GPL-3.0-or-later
'use strict';
// Curves of the experiments: choose a quantity and cases, read values, zoom.

(() => {
  const data = flexneck.data.curves;
  if (!data) return;
  const {element, digits} = flexneck;
  const margin = {top: 16, right: 26, bottom: 42, left: 78};
  const height = 360;
  /** Distinct without colour vision (Okabe and Ito); the dashes distinguish them in grey, too. */
  const colours = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7f7f7f'];
  /** Solid, dashed, dotted and mixed, then with ever more dashes to a dot or dots to a dash. */
  const dashOf = (k) => {
    const first = ['', '8 4', '2 3', '9 3 2 3', '18 4', '9 3 2 3 2 3'];
    if (k < first.length) return first[k];
    const [dash, dot, many] = ['9 3 ', '2 3 ', Math.floor(k / 2)];
    return (k % 2 === 0 ? dash.repeat(many) + dot : dash + dot.repeat(many)).trim();
  };
  /** Colour and width tell the case, the dashes its variant: no two curves look alike. */
  const styleOf = (place, variant, variants) => ({
    stroke: colours[place % colours.length],
    width: 1.8 + 1.6 * Math.floor(place / colours.length),
    dash: dashOf((place + variant) % Math.max(variants, 6)),
  });

  /** Measured curves stand beside the runs, as one more variant of their case. */
  const runs = [...data.runs, ...data.measured].map((run) => ({
    ...run,
    times: flexneck.unpack(run.times, Float32Array),
    channels: new Map(run.channels.map((channel) => [channel.name, channel])),
  }));
  const bands = data.bands.map((band) => ({
    ...band,
    ...Object.fromEntries(['times', 'lower', 'upper'].map(
        (key) => [key, flexneck.unpack(band[key], Float32Array)])),
  }));
  const valuesOf = (channel) =>
      channel.unpacked || (channel.unpacked = flexneck.unpack(channel.values, Float32Array));
  /** "flexion-60-rigid" is the variant "rigid" of the case "flexion-60", if there is such a case. */
  const split = (run, all) => {
    const base = all.find((other) => run.name.startsWith(`${other.name}-`));
    return base ? [base.name, run.name.slice(base.name.length + 1)] : [run.name, ''];
  };

  const {units} = flexneck;
  const shown = (unit, kind) => units.of(unit, data.units[kind]);
  const kMs = 1000;  // time is in ms in both systems

  class Plot {
    constructor(container) {
      this.container = container;
      this.kind = container.dataset.kind;
      this.runs = runs.filter((run) => run.kind === this.kind);
      const names = new Set(this.runs.flatMap((run) => [...run.channels.keys()]));
      container.hidden = names.size === 0;
      if (container.hidden) return;
      const choice = (options, wanted, label) => {
        const select = element('select');
        for (const name of options) select.append(element('option', {}, name));
        if (options.includes(wanted)) select.value = wanted;
        select.addEventListener('change', () => this.reset());
        return [element('label', {}, `${label} `, select), select];
      };
      const [upwards, y] = choice([...names], container.dataset.channel, 'Show');
      const [along, x] = choice(['time', ...names], container.dataset.against, 'over');
      Object.assign(this, {x, y});
      const title = this.kind === 'pendulum' ? 'Pendulum' : 'Static neck tester';
      const controls = element('div', {class: 'controls'}, element('h3', {}, title), upwards, along);
      for (const [text, key] of [['+', '+'], ['−', '-'], ['All', 'Home']]) {
        const button = element('button', {type: 'button'}, text);
        if (text !== 'All') button.setAttribute('aria-label', `Zoom ${key === '+' ? 'in' : 'out'}`);
        button.addEventListener('click', () => this.press(key, 1));
        controls.append(button);
      }
      controls.append(flexneck.saveButtons(`the curves: ${title}`, {
        CSV: () => flexneck.save(`${this.name()}.csv`, this.csv(), 'text/csv'),
        SVG: () => flexneck.saveSvg(this.name(), this.picture()),
        PNG: () => flexneck.savePng(this.name(), this.picture()),
      }));
      this.makeChoices();
      this.drawing = element('div', {class: 'drawing'});
      this.reading = element('output', {class: 'note'});
      this.legend = element('ul', {class: 'legend', 'aria-label': 'Curves drawn'});
      container.append(controls, this.drawing, this.legend, this.reading, ...this.choices);
      this.svg = d3.select(this.drawing).append('svg')
          .attr({tabindex: 0, role: 'img', height}).node();
      this.listen();
      this.reset();
      new ResizeObserver(() => this.draw()).observe(this.drawing);
    }

    /** Cases and their variants: what is drawn is every chosen variant of every chosen case. */
    makeChoices() {
      const pairs = this.runs.map((run) => split(run, this.runs));
      const cases = [...new Set(pairs.map(([name]) => name))];
      const variants = [...new Set(pairs.map(([, variant]) => variant))];
      this.shownCases = new Set(cases.slice(0, 5));
      const measured = new Set(data.measured.map((run) => run.name));
      this.shownVariants = new Set(
          ['', ...(data.folders || []), ...pairs.filter((_, k) => measured.has(this.runs[k].name)).map(([, name]) => name)]);
      this.curves = this.runs.map((run, k) => {
        const [place, variant] = [cases.indexOf(pairs[k][0]), variants.indexOf(pairs[k][1])];
        return {run, case: pairs[k][0], variant: pairs[k][1],
                ...styleOf(place, variant, variants.length)};
      });
      const group = (label, names, chosen, textOf) => {
        const buttons = names.map((name) => {
          const button = element('button', {type: 'button', 'data-choice': name,
                                            'aria-pressed': chosen.has(name)}, textOf(name));
          button.addEventListener('click', () => {
            if (!chosen.delete(name)) chosen.add(name);
            button.setAttribute('aria-pressed', chosen.has(name));
            this.draw();
          });
          return button;
        });
        return element('div', {class: 'controls', role: 'group', 'aria-label': label},
                       element('span', {class: 'note'}, label), ...buttons);
      };
      this.choices = [group('Cases', cases, this.shownCases, (name) => name)];
      if (variants.length > 1) {
        this.choices.push(group('Variants', variants, this.shownVariants,
                                (name) => name || 'plain'));
      }
    }

    /** A line for each curve drawn: its stroke, its name and, while one reads, its value. */
    fillLegend(drawn) {
      this.legend.replaceChildren(...drawn.map((curve) => {
        curve.value = element('span', {class: 'value'});
        const item = element('li', {'data-curve': curve.run.name});
        d3.select(item).append('svg').attr({width: 62, height: 8, 'aria-hidden': true})
            .append('line').attr({x1: 1, x2: 61, y1: 4, y2: 4, class: 'curve',
                                  stroke: curve.stroke, 'stroke-width': curve.width,
                                  'stroke-dasharray': curve.dash});
        item.append(curve.run.name, curve.value);
        return item;
      }));
    }

    name() { return flexneck.fileName(`${this.kind} ${this.y.value} over ${this.x.value}`); }

    picture() { return flexneck.standaloneSvg(this.svg, this.drawn.map((curve) => ({...curve, name: curve.run.name}))); }

    /** All points of the curves drawn: curves over the same x share its column, others have their own. */
    csv() {
      const head = [];
      const columns = [];
      const add = (title, values) => {
        head.push(title);
        columns.push(values);
      };
      const title = (name) => this.label(name).replace(/ \((.*)\)$/, ' [$1]')
          .replaceAll('·', '*').replaceAll('²', '^2').replaceAll('³', '^3');
      let before = null;
      for (const {run, points} of this.drawn) {
        const x = points.map((point) => point[0]);
        if (String(x) !== String(before)) add(title(this.x.value), x);
        before = x;
        add(`${run.name}: ${title(this.y.value)}`, points.map((point) => point[1]));
      }
      const rows = Array.from({length: Math.max(0, ...columns.map((values) => values.length))},
                              (_, k) => columns.map((values) => k < values.length ? Number(values[k].toPrecision(7)) : ''));
      return flexneck.csv([head, ...rows]);
    }

    /** The points of a case in the units shown; none if it has not the channels. */
    points(run) {
      const read = (name) => {
        if (name === 'time') return {values: run.times, factor: kMs};
        const channel = run.channels.get(name);
        return channel && {values: valuesOf(channel), ...shown(channel.unit, this.kind)};
      };
      const [x, y] = [read(this.x.value), read(this.y.value)];
      if (!x || !y) return [];
      return Array.from(x.values, (value, i) => [value * x.factor, y.values[i] * y.factor]);
    }

    label(name) {
      if (name === 'time') return 'time (ms)';
      const channel = this.runs.map((run) => run.channels.get(name)).find(Boolean);
      return `${name} (${shown(channel.unit, this.kind).name})`;
    }

    /** Everything in view. */
    reset() {
      this.window = null;
      this.cursor = null;
      this.draw();
    }

    draw() {
      const width = this.drawing.clientWidth;
      if (width === 0) return;
      for (const curve of this.curves) {
        const isShown = this.shownCases.has(curve.case) && this.shownVariants.has(curve.variant);
        curve.points = isShown ? this.points(curve.run) : [];
      }
      const drawn = this.curves.filter((curve) => curve.points.length > 0);
      this.drawn = drawn;
      this.fillLegend(drawn);
      this.full = d3.extent(drawn.flatMap((curve) => curve.points.map(([x]) => x)));
      const [left, right] = this.window || this.full;
      const inView = drawn.flatMap(
          (curve) => curve.points.filter(([x]) => x >= left && x <= right).map(([, y]) => y));
      const corridors = this.corridors(drawn);
      const shownBands = this.bands(drawn);
      const heights = [0, ...inView, ...corridors.flatMap(({values}) => values),
                       ...shownBands.flatMap(({points}) => points.map(([, y]) => y))];
      this.scaleX = d3.scale.linear().domain([left, right]).range([margin.left, width - margin.right]);
      this.scaleY = d3.scale.linear().domain(d3.extent(heights)).nice()
          .range([height - margin.bottom, margin.top]);
      const svg = d3.select(this.svg).attr({width});
      svg.selectAll('*').remove();
      svg.attr('viewBox', `0 0 ${width} ${height}`);  // paper is of another width
      svg.attr('aria-label', `${this.label(this.y.value)} over ${this.label(this.x.value)}: ` +
                             (drawn.map((curve) => curve.run.name).join(', ') || 'no case chosen'));
      if (drawn.length === 0) return;
      this.drawAxes(svg, width);
      const clip = `clip-${[...document.querySelectorAll('.plot')].indexOf(this.container)}`;
      svg.append('clipPath').attr('id', clip).append('rect').attr({
        x: margin.left, y: margin.top, width: width - margin.left - margin.right,
        height: height - margin.top - margin.bottom});
      const inside = svg.append('g').attr('clip-path', `url(#${clip})`);
      this.drawBands(inside, shownBands);
      this.drawCorridors(inside, corridors);
      const line = d3.svg.line().x(([x]) => this.scaleX(x)).y(([, y]) => this.scaleY(y));
      for (const curve of drawn) {
        inside.append('path').attr({class: 'curve', d: line(curve.points), stroke: curve.stroke,
                                    'stroke-width': curve.width, 'stroke-dasharray': curve.dash});
      }
      this.labelCorridors(inside, corridors);
      this.mark = inside.append('g');
      this.read(this.cursor);
    }

    drawAxes(svg, width) {
      const axis = (scale, orient, ticks, size) => d3.svg.axis().scale(scale).orient(orient)
          .ticks(ticks).innerTickSize(size).outerTickSize(0).tickPadding(8)
          .tickFormat((value) => String(Number(value.toPrecision(12))).replace('-', '−'));
      svg.append('g').attr({class: 'axis', transform: `translate(0,${height - margin.bottom})`})
          .call(axis(this.scaleX, 'bottom', width / 90, margin.top + margin.bottom - height));
      svg.append('g').attr({class: 'axis', transform: `translate(${margin.left},0)`})
          .call(axis(this.scaleY, 'left', 7, margin.left + margin.right - width));
      svg.append('line').attr({class: 'zero', x1: margin.left, x2: width - margin.right,
                               y1: this.scaleY(0), y2: this.scaleY(0)});
      svg.append('text').attr({class: 'label', x: width - margin.right, y: height - 6,
                               'text-anchor': 'end'}).text(this.label(this.x.value));
      svg.append('text').attr({class: 'label', transform: 'rotate(-90)', x: -margin.top, y: 14,
                               'text-anchor': 'end'}).text(this.label(this.y.value));
    }

    /** What a standard asks of the curves drawn, in the units shown. */
    corridors(drawn) {
      if (this.x.value !== 'time') return [];
      const names = drawn.map((curve) => curve.run.name);
      return data.corridors
          .filter((each) => each.channel === this.y.value && names.includes(each.case))
          .map((each) => {
            const {factor} = shown(each.unit, this.kind);
            return {what: each.what, times: each.times.map((time) => time * kMs),
                    values: each.values.map((value) => value * factor)};
          });
    }

    /** Corridors between two curves, as the points round them. */
    bands(drawn) {
      if (this.x.value !== 'time') return [];
      const names = drawn.map((curve) => curve.run.name);
      return bands
          .filter((each) => each.channel === this.y.value && names.includes(each.case))
          .map(({what, unit, times, lower, upper}) => {
            const {factor} = shown(unit, this.kind);
            const edge = (values) => Array.from(
                values, (value, k) => [times[k] * kMs, value * factor]);
            return {what, points: [...edge(lower), ...edge(upper).reverse()]};
          });
    }

    drawBands(inside, shownBands) {
      const line = d3.svg.line().x(([x]) => this.scaleX(x)).y(([, y]) => this.scaleY(y));
      for (const {what, points} of shownBands) {
        inside.append('path').attr({class: 'corridor', d: `${line(points)}Z`})
            .append('title').text(`corridor of ${what}`);
      }
    }

    drawCorridors(inside, corridors) {
      for (const {what, times, values} of corridors) {
        const [left, right] = times.map(this.scaleX);
        const [bottom, top] = values.map(this.scaleY);
        inside.append('rect').attr({class: 'corridor', x: left, width: right - left,
                                    y: top - 2, height: bottom - top + 4});
      }
    }

    /** Names of the corridors, in front of the curves. */
    labelCorridors(inside, corridors) {
      for (const {what, times, values} of corridors) {
        const [bottom, top] = values.map(this.scaleY);
        inside.append('text').attr({class: 'corridor', x: this.scaleX(times[1]) + 5,
                                    y: top + 10 - (top === bottom) * 18}).text(what);
      }
    }

    /** Values at x, beside the names and on a line through the curves. */
    read(x) {
      this.cursor = x;
      for (const curve of this.drawn) curve.value.textContent = '';
      this.reading.textContent = '';
      if (!this.mark || this.drawn.length === 0) return;
      this.mark.selectAll('*').remove();
      if (x === null) return;
      const at = this.scaleX(x);
      this.mark.append('line').attr({class: 'cursor', x1: at, x2: at, y1: margin.top,
                                     y2: height - margin.bottom});
      for (const curve of this.drawn) {
        const nearest = curve.points.reduce(
            (best, point) => Math.abs(point[0] - x) < Math.abs(best[0] - x) ? point : best);
        curve.value.textContent = digits(nearest[1]);
        this.mark.append('circle').attr({cx: this.scaleX(nearest[0]), cy: this.scaleY(nearest[1]),
                                         r: 3.5, fill: curve.stroke});
      }
      this.reading.textContent = `at ${digits(x)}: ${this.label(this.x.value)}`;
    }

    /** The view narrowed or widened about the reading line. */
    zoom(factor) {
      const [left, right] = this.scaleX.domain();
      const fixed = this.cursor === null ? (left + right) / 2 : this.cursor;
      this.show(fixed + (left - fixed) * factor, fixed + (right - fixed) * factor);
    }

    show(left, right) {
      const [low, high] = this.full;
      this.window = [Math.max(left, low), Math.min(right, high)];
      if (this.window[1] - this.window[0] >= high - low) this.window = null;
      this.draw();
    }

    press(key, times) {
      if (!this.scaleX) return false;
      const [left, right] = this.scaleX.domain();
      const step = times * (right - left) / 200;
      const from = this.cursor === null ? left : this.cursor;
      const actions = {
        ArrowLeft: () => this.read(Math.max(left, from - step)),
        ArrowRight: () => this.read(Math.min(right, from + step)),
        '+': () => this.zoom(0.5), '=': () => this.zoom(0.5), '-': () => this.zoom(2),
        Home: () => this.reset(),
      };
      if (!actions[key]) return false;
      actions[key]();
      return true;
    }

    listen() {
      const {svg} = this;
      const position = (event) => {
        const [left, right] = this.scaleX.domain();
        const x = this.scaleX.invert(event.clientX - svg.getBoundingClientRect().left);
        return Math.min(Math.max(x, left), right);
      };
      let start = null;
      svg.addEventListener('pointerdown', (event) => {
        start = position(event);
        svg.setPointerCapture(event.pointerId);
      });
      svg.addEventListener('pointermove', (event) => {
        const x = position(event);
        this.read(x);
        if (start === null) return;
        const [left, right] = [this.scaleX(Math.min(start, x)), this.scaleX(Math.max(start, x))];
        this.mark.append('rect').attr({class: 'brush', x: left, width: right - left, y: margin.top,
                                       height: height - margin.top - margin.bottom});
      });
      svg.addEventListener('pointerup', (event) => {
        const end = position(event);
        const pixels = Math.abs(this.scaleX(end) - this.scaleX(start === null ? end : start));
        if (pixels > 8) this.show(Math.min(start, end), Math.max(start, end));
        start = null;
      });
      svg.addEventListener('pointercancel', () => { start = null; });
      svg.addEventListener('pointerleave', () => { if (start === null) this.read(null); });
      svg.addEventListener('dblclick', () => this.reset());
      svg.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        if (this.press(event.key, event.shiftKey ? 10 : 1)) event.preventDefault();
      });
    }
  }

  const plots = [...document.querySelectorAll('.plot')].map((container) => new Plot(container))
      .filter((plot) => !plot.container.hidden);
  units.follow(() => {
    for (const plot of plots) plot.reset();
  });
})();
