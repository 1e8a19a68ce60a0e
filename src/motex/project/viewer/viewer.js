// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// @ts-check

const kPlayIcon = 'M7 4l13 8-13 8z', kPauseIcon = 'M6 4h4v16H6zM14 4h4v16h-4z';

/** @template {HTMLElement} T @param {string} id @returns {T} */
function element(id) { return /** @type {T} */ (document.getElementById(id)); }

/** Time, controls and read-out. */
class Viewer {
  /** @param {PageData} data */
  constructor(data) {
    this.data = data;
    this.motion = new Motion(data);
    this.camera = new Camera(data.frontYaw + 0.45, Math.max(3.6, 2.4 * this.motion.radius()));
    this.scene = new Scene(element('view'), this.motion, this.camera);
    this.timeline = new Timeline(this.motion, (frame) => this.seek(frame));
    this.time = 0;
    this.playing = false;
    this.lastTick = 0;
    this.dirty = true;
    this.slider = /** @type {HTMLInputElement} */ (element('slider'));
    this.slider.max = String(Math.max(0, data.numFrames - 1));
    this.followBox = /** @type {HTMLInputElement} */ (element('follow'));
    this.trailsBox = /** @type {HTMLInputElement} */ (element('trails'));
    this.speed = /** @type {HTMLSelectElement} */ (element('speed'));
    this.showFacts();
    this.listen();
    this.resize();
    requestAnimationFrame((now) => this.tick(now));
  }

  get frame() { return Math.min(Math.floor(this.time), this.data.numFrames - 1); }

  play() { this.setPlaying(true); }
  pause() { this.setPlaying(false); }

  /** @param {boolean} playing */
  setPlaying(playing) {
    this.playing = playing && this.data.numFrames > 1;
    element('play-icon').setAttribute('d', this.playing ? kPauseIcon : kPlayIcon);
    this.dirty = true;
  }

  /** @param {number} frame */
  seek(frame) {
    this.time = Math.max(0, Math.min(this.data.numFrames - 1, Math.round(frame)));
    this.paint();
  }

  /** @param {number} now milliseconds */
  tick(now) {
    const secs = Math.min(0.1, (now - this.lastTick) / 1000);
    this.lastTick = now;
    if (this.playing) {
      this.time += secs * Number(this.speed.value) / this.data.frameTimeSecs;
      if (this.time >= this.data.numFrames) this.time = 0;
      this.dirty = true;
    }
    if (this.dirty) this.paint();
    requestAnimationFrame((next) => this.tick(next));
  }

  paint() {
    this.dirty = false;
    const time = Math.min(this.time, this.data.numFrames - 1);
    if (this.followBox.checked) this.camera.target = this.motion.followed(time);
    this.scene.paint(time, this.trailsBox.checked);
    this.timeline.paint(time, this.scene.palette);
    this.slider.value = String(this.frame);
    this.showReadout();
  }

  showFacts() {
    const {name, numFrames, frameTimeSecs, spans} = this.data;
    element('name').textContent = name || 'motion';
    const textons = new Set(spans.map((s) => s.texton)).size;
    element('facts').textContent = `${(numFrames * frameTimeSecs).toFixed(1)} s · ${numFrames} frames at ` +
      `${+(1 / frameTimeSecs).toFixed(2)} a second${textons ? ` · ${spans.length} segments of ${textons} textons` : ''}`;
  }

  showReadout() {
    const {numFrames, frameTimeSecs} = this.data, span = this.motion.spanAt(this.frame);
    const total = (numFrames - 1) * frameTimeSecs;
    const make = (/** @type {string} */ tag, /** @type {string} */ text, /** @type {string} */ name = '') => {
      const node = document.createElement(tag);
      node.textContent = text;
      node.className = name;
      return node;
    };
    const parts = [make('b', `${(this.frame * frameTimeSecs).toFixed(2)} s`), make('span', ` / ${total.toFixed(2)} s`, 'of'),
      make('span', 'frame ', 'of next'), make('b', String(this.frame)), make('span', ` / ${numFrames - 1}`, 'of')];
    if (span) {
      const swatch = make('span', '', 'swatch');
      swatch.style.background = span.colour;
      parts.push(swatch, make('span', 'texton ', 'of'), make('b', String(span.texton)));
    }
    element('readout').replaceChildren(...parts);
  }

  resize() {
    this.scene.resize();
    this.dirty = true;
  }

  resetView() {
    this.camera.reset();
    this.camera.target = this.motion.followed(this.time);
    this.dirty = true;
  }

  /** To the start of this texton, or of the one before or after it. @param {number} direction −1 or 1 */
  jumpTexton(direction) {
    const starts = this.data.spans.map((s) => s.start);
    const next = direction > 0 ? starts.find((s) => s > this.frame) : starts.reverse().find((s) => s < this.frame);
    if (next !== undefined) this.seek(next);
  }

  /** @param {HTMLInputElement} box */
  toggle(box) {
    box.checked = !box.checked;
    this.dirty = true;
  }

  listen() {
    const changed = () => { this.dirty = true; };
    this.camera.listen(element('view'), changed);
    new ResizeObserver(() => this.resize()).observe(element('stage'));
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.scene.palette = new Palette();
      changed();
    });
    element('play').addEventListener('click', () => this.setPlaying(!this.playing));
    element('back').addEventListener('click', () => this.step(-1));
    element('forward').addEventListener('click', () => this.step(1));
    element('reset').addEventListener('click', () => this.resetView());
    this.slider.addEventListener('input', () => this.seek(Number(this.slider.value)));
    this.followBox.addEventListener('change', changed);
    this.trailsBox.addEventListener('change', changed);
    document.addEventListener('keydown', (e) => this.onKey(e));
  }

  /** @param {number} frames */
  step(frames) {
    this.pause();
    this.seek(this.frame + frames);
  }

  /** @param {KeyboardEvent} e */
  onKey(e) {
    if (e.ctrlKey || e.metaKey || e.altKey || e.target === this.speed) return;
    const far = e.shiftKey ? 10 : 1;
    /** @type {Record<string, () => void>} */
    const actions = {
      ' ': () => this.setPlaying(!this.playing),
      'ArrowLeft': () => this.step(-far), 'ArrowRight': () => this.step(far),
      'Home': () => this.seek(0), 'End': () => this.seek(this.data.numFrames - 1),
      '[': () => this.jumpTexton(-1), ']': () => this.jumpTexton(1),
      'f': () => this.toggle(this.followBox), 't': () => this.toggle(this.trailsBox), 'r': () => this.resetView(),
    };
    const action = actions[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    if (!action) return;
    e.preventDefault();
    action();
  }
}

{
  const viewer = new Viewer(JSON.parse(/** @type {string} */ (element('motex-data').textContent)));
  Object.defineProperty(window, 'motexViewer', {value: {
    get frame() { return viewer.frame; },
    get numFrames() { return viewer.data.numFrames; },
    get playing() { return viewer.playing; },
    seek: (/** @type {number} */ frame) => viewer.seek(frame),
    play: () => viewer.play(),
    pause: () => viewer.pause(),
  }});
  if (!matchMedia('(prefers-reduced-motion: reduce)').matches) viewer.play();
}
