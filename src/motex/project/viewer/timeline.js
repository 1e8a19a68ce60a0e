// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// @ts-check

/** The strip of textons under the view: shows which plays, names the one under the pointer, jumps to its start. */
class Timeline {
  /** @param {Motion} motion @param {(frame: number) => void} seek */
  constructor(motion, seek) {
    this.motion = motion;
    this.box = /** @type {HTMLElement} */ (document.getElementById('strip-box'));
    this.canvas = /** @type {HTMLCanvasElement} */ (document.getElementById('strip'));
    this.tip = /** @type {HTMLElement} */ (document.getElementById('tip'));
    this.box.hidden = motion.data.spans.length === 0;
    this.canvas.addEventListener('pointermove', (e) => this.showTip(e.offsetX));
    this.canvas.addEventListener('pointerleave', () => { this.tip.hidden = true; });
    this.canvas.addEventListener('click', (e) => {
      const span = motion.spanAt(this.frameAt(e.offsetX));
      if (span) seek(span.start);
    });
  }

  /** @param {number} x css pixels */
  frameAt(x) { return Math.floor(x / this.canvas.clientWidth * this.motion.data.numFrames); }

  /** @param {number} x css pixels */
  showTip(x) {
    const span = this.motion.spanAt(this.frameAt(x));
    this.tip.hidden = !span;
    if (!span) return;
    const from = span.source ? `\nfrom ${span.source}` : '';
    this.tip.textContent = `texton ${span.texton} · frames ${span.start}–${span.start + span.length - 1}${from}`;
    const half = this.tip.offsetWidth / 2;
    this.tip.style.left = `${Math.max(half, Math.min(this.canvas.clientWidth - half, x))}px`;
  }

  /** @param {number} time in frames @param {Palette} palette */
  paint(time, palette) {
    if (this.box.hidden) return;
    const ratio = Math.min(window.devicePixelRatio || 1, 3), {canvas} = this;
    const width = canvas.width = Math.round(canvas.clientWidth * ratio), height = canvas.height = Math.round(canvas.clientHeight * ratio);
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    const {spans, numFrames} = this.motion.data, now = this.motion.spanAt(Math.floor(time));
    context.font = `${11 * ratio}px system-ui, sans-serif`;
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    for (const span of spans) {
      const x = span.start / numFrames * width, wide = span.length / numFrames * width;
      context.globalAlpha = span === now ? 1 : span.texton === now?.texton ? 0.85 : 0.55;
      context.fillStyle = span.colour;
      context.fillRect(x, 0, Math.max(wide - Math.min(ratio, wide * 0.2), 0.5), height);
      context.globalAlpha = 1;
      const label = String(span.texton);
      if (context.measureText(label).width > wide - 4 * ratio) continue;
      context.fillStyle = span === now ? '#10121a' : palette.ink;
      context.fillText(label, x + wide / 2, height / 2 + ratio);
    }
    context.fillStyle = palette.mark;
    context.fillRect((time + 0.5) / numFrames * width - ratio, 0, 2 * ratio, height);
  }
}
