// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// @ts-check
'use strict';

/** @typedef {[number, number, number]} Vec3  metres, Y up */
/** @typedef {{side: number, balls: [number, number][]}} Part  side: 0 middle, 1 left, 2 right; balls: point, radius in units */
/** @typedef {{texton: number, start: number, length: number, source: string, colour: string}} Span */
/**
 * @typedef {object} PageData
 * @property {string} name
 * @property {number} frameTimeSecs
 * @property {number} numFrames
 * @property {number} numPoints
 * @property {Vec3} origin     position of the quantised (0, 0, 0), in the clip's unit, floor at y = 0
 * @property {number} step     clip units to one quantum
 * @property {number} scale    metres to the clip's unit, or what makes the body 1.7 m high
 * @property {string} points   base64 of frames × points × (x, y, z), u16, little-endian; 65535: not seen
 * @property {Part[]} parts
 * @property {number[]} trails points that leave a trail
 * @property {number[]} trailSides
 * @property {number[]} centre points whose mean is the middle of the body
 * @property {number} frontYaw direction in radians into which the body looks at first, 0 = +Z, towards +X
 * @property {Span[]} spans
 */

/** Positions of the body's points at any time, in metres. */
class Motion {
  /** @param {PageData} data */
  constructor(data) {
    this.data = data;
    this.quanta = Motion.decode(data.points, data.numFrames * data.numPoints * 3);
    /** @type {Float32Array} points × 3 of the frame asked for last */
    this.pose = new Float32Array(data.numPoints * 3);
    this.path = this.smoothPath();
  }

  /** @param {string} base64 @param {number} count @returns {Uint16Array} */
  static decode(base64, count) {
    const text = atob(base64), out = new Uint16Array(count);
    for (let i = 0; i < count; ++i) out[i] = text.charCodeAt(2 * i) | text.charCodeAt(2 * i + 1) << 8;
    return out;
  }

  /** @param {number} frame @param {number} point @param {number} axis @returns {number} metres; NaN: not seen */
  coordinate(frame, point, axis) {
    const kNotSeen = 65535, {numPoints, origin, step, scale} = this.data;
    const quantum = this.quanta[(frame * numPoints + point) * 3 + axis];
    return quantum === kNotSeen ? NaN : (origin[axis] + quantum * step) * scale;
  }

  /** Fills `pose`; between two frames positions are mixed. @param {number} time in frames */
  setTime(time) {
    const {numFrames, numPoints} = this.data;
    const a = Math.min(Math.floor(time), numFrames - 1), b = Math.min(a + 1, numFrames - 1), w = time - a;
    for (let p = 0; p < numPoints; ++p)
      for (let k = 0; k < 3; ++k)
        this.pose[3 * p + k] = w === 0 ? this.coordinate(a, p, k) : (1 - w) * this.coordinate(a, p, k) + w * this.coordinate(b, p, k);
  }

  /** Middle of the body on the floor, one a frame, smoothed over about a second so that a camera can follow it. */
  smoothPath() {
    const {numFrames, centre, frameTimeSecs} = this.data, reach = Math.max(1, Math.round(0.5 / frameTimeSecs));
    let path = [0, 2].map((axis) => {
      let last = 0;
      return Float64Array.from({length: numFrames}, (_, t) => {
        const seen = centre.map((p) => this.coordinate(t, p, axis)).filter((x) => !Number.isNaN(x));
        if (seen.length > 0) last = seen.reduce((sum, x) => sum + x, 0) / seen.length;
        return last;
      });
    });
    for (let pass = 0; pass < 2; ++pass) path = path.map((values) => Motion.boxFilter(values, reach));
    return path;
  }

  /** Mean over ± reach frames, less at the ends. @param {Float64Array} values @param {number} reach */
  static boxFilter(values, reach) {
    const sums = new Float64Array(values.length + 1);
    values.forEach((v, t) => { sums[t + 1] = sums[t] + v; });
    return values.map((_, t) => {
      const r = Math.min(reach, t, values.length - 1 - t);
      return (sums[t + r + 1] - sums[t - r]) / (2 * r + 1);
    });
  }

  /** @param {number} time in frames @returns {Vec3} where a following camera looks */
  followed(time) {
    const a = Math.min(Math.floor(time), this.data.numFrames - 1), b = Math.min(a + 1, this.data.numFrames - 1), w = time - a;
    const at = (/** @type {number} */ k) => (1 - w) * this.path[k][a] + w * this.path[k][b];
    return [at(0), 0.88, at(1)];
  }

  /** @returns {number} metres from where a following camera looks to the farthest point of the first frame */
  radius() {
    const [x, , z] = this.followed(0);
    let most = 0;
    for (let p = 0; p < this.data.numPoints; ++p) {
      const r = Math.hypot(this.coordinate(0, p, 0) - x, this.coordinate(0, p, 2) - z);
      if (r > most) most = r;
    }
    return most;
  }

  /** @param {number} frame @returns {Span | undefined} */
  spanAt(frame) {
    return this.data.spans.find((s) => frame >= s.start && frame < s.start + s.length);
  }
}
