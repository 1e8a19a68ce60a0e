// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// @ts-check

/** @typedef {{x: number, y: number, depth: number, scale: number}} Projected  scale: pixels to the metre at that depth */

/** Looks at `target` from `distance` metres; yaw 0 stands on the +Z side, pitch > 0 above. */
class Camera {
  /** @param {number} yaw @param {number} distance metres */
  constructor(yaw, distance = 3.6) {
    this.home = yaw;
    this.homeDistance = distance;
    this.width = this.height = 1;
    this.reset();
  }

  reset() {
    this.yaw = this.home;
    this.pitch = 0.2;
    this.distance = this.homeDistance;
    /** @type {Vec3} */
    this.target = [0, 0.88, 0];
    /** @type {Vec3} moved away from the target by hand */
    this.shift = [0, 0, 0];
  }

  /** Call after every change. @param {number} width pixels @param {number} height */
  update(width, height) {
    this.width = width;
    this.height = height;
    const cy = Math.cos(this.yaw), sy = Math.sin(this.yaw), cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
    /** @type {Vec3} */ this.right = [cy, 0, -sy];
    /** @type {Vec3} */ this.up = [-sp * sy, cp, -sp * cy];
    /** @type {Vec3} */ this.towards = [cp * sy, sp, cp * cy];
    this.focal = 1.5 * Math.min(height, 1.6 * width);
    this.eye = [0, 1, 2].map((k) => this.target[k] + this.shift[k] + this.distance * this.towards[k]);
  }

  /** @param {number} x @param {number} y @param {number} z @returns {Projected} depth ≤ 0: behind the eye */
  project(x, y, z) {
    const dx = x - this.eye[0], dy = y - this.eye[1], dz = z - this.eye[2];
    const depth = -(dx * this.towards[0] + dy * this.towards[1] + dz * this.towards[2]);
    const scale = this.focal / Math.max(depth, 1e-3);
    return {
      x: this.width / 2 + scale * (dx * this.right[0] + dz * this.right[2]),
      y: this.height / 2 - scale * (dx * this.up[0] + dy * this.up[1] + dz * this.up[2]),
      depth, scale,
    };
  }

  /** @param {number} dx pixels @param {number} dy */
  orbit(dx, dy) {
    this.yaw -= dx * 0.008;
    this.pitch = Math.max(-0.05, Math.min(1.5, this.pitch + dy * 0.006));
  }

  /** @param {number} factor */
  zoom(factor) { this.distance = Math.max(1, Math.min(30, this.distance * factor)); }

  /** @param {number} dx pixels @param {number} dy */
  move(dx, dy) {
    const metres = this.distance / this.focal;
    for (let k = 0; k < 3; ++k) this.shift[k] += metres * (dy * this.up[k] - dx * this.right[k]);
  }

  /** Drag turns, shift-drag or the right button moves, wheel and pinch zoom. @param {HTMLElement} element @param {() => void} changed */
  listen(element, changed) {
    /** @type {Map<number, {x: number, y: number}>} */
    const fingers = new Map();
    const spread = () => {
      const [a, b] = [...fingers.values()];
      return Math.hypot(a.x - b.x, a.y - b.y);
    };
    element.addEventListener('pointerdown', (e) => {
      element.setPointerCapture(e.pointerId);
      fingers.set(e.pointerId, {x: e.clientX, y: e.clientY});
    });
    element.addEventListener('pointermove', (e) => {
      const last = fingers.get(e.pointerId);
      if (!last) return;
      const dx = e.clientX - last.x, dy = e.clientY - last.y, before = fingers.size === 2 ? spread() : 0;
      fingers.set(e.pointerId, {x: e.clientX, y: e.clientY});
      if (fingers.size === 2) {
        this.zoom(before / Math.max(1, spread()));
        this.move(dx / 2, dy / 2);
      } else if (e.shiftKey || (e.buttons & 2)) this.move(dx, dy);
      else this.orbit(dx, dy);
      changed();
    });
    for (const end of ['pointerup', 'pointercancel'])
      element.addEventListener(end, (e) => { fingers.delete(/** @type {PointerEvent} */ (e).pointerId); });
    element.addEventListener('contextmenu', (e) => e.preventDefault());
    element.addEventListener('wheel', (e) => {
      e.preventDefault();
      this.zoom(Math.exp(Math.max(-0.3, Math.min(0.3, e.deltaY * (e.deltaMode ? 0.03 : 0.0012)))));
      changed();
    }, {passive: false});
  }
}
