// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// @ts-check

/** @typedef {{x: number, y: number}} Spot */
/** @typedef {{x: number, y: number, r: number}} Disc */

const kRim = 24;
const kRimDirections = Array.from({length: kRim}, (_, i) => [Math.cos(2 * Math.PI * i / kRim), Math.sin(2 * Math.PI * i / kRim)]);
/** @type {Vec3} towards the light */
const kLight = [-0.35, 1, 0.25];

/** Convex hull (monotone chain). @param {Spot[]} spots @returns {Spot[]} */
function hull(spots) {
  spots.sort((a, b) => a.x - b.x || a.y - b.y);
  /** @type {Spot[]} */
  const out = [];
  for (let pass = 0; pass < 2; ++pass) {
    const start = out.length;
    for (const p of spots) {
      while (out.length >= start + 2) {
        const a = out[out.length - 2], b = out[out.length - 1];
        if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0) break;
        out.pop();
      }
      out.push(p);
    }
    out.pop();
    spots.reverse();
  }
  return out;
}

/** @param {string} hex "#rrggbb" @returns {Vec3} */
function channels(hex) {
  return /** @type {Vec3} */ ([1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)));
}

/** @param {Vec3} a @param {Vec3} b @param {number} weight of b */
function mixed(a, b, weight) {
  return `rgb(${a.map((v, k) => Math.round(v + weight * (b[k] - v))).join(' ')})`;
}

/** Colours of the page's style sheet, in the light or dark dress that it wears. */
class Palette {
  constructor() {
    const style = getComputedStyle(document.documentElement);
    const colour = (/** @type {string} */ name) => style.getPropertyValue('--' + name).trim();
    this.line = colour('line');
    this.shadow = colour('shadow');
    this.mark = colour('mark');
    this.ink = colour('ink');
    this.sides = ['middle', 'left', 'right'].map(colour);
    this.shades = this.sides.map((hex) => {
      const c = channels(hex);
      return {
        rim: mixed(c, [20, 22, 40], 0.6),
        ramp: [mixed(c, [255, 255, 255], 0.06), mixed(c, [255, 255, 255], 0.34), mixed(c, [255, 255, 255], 0.12),
          mixed(c, [20, 22, 40], 0.05), mixed(c, [20, 22, 40], 0.22), mixed(c, [20, 22, 40], 0.42)],
      };
    });
  }
}

/** Paints floor, shadow, trails and body. */
class Scene {
  /** @param {HTMLCanvasElement} canvas @param {Motion} motion @param {Camera} camera */
  constructor(canvas, motion, camera) {
    this.canvas = canvas;
    this.context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
    this.motion = motion;
    this.camera = camera;
    this.palette = new Palette();
    this.shadowCanvas = document.createElement('canvas');
    this.trailSecs = 1.2;
  }

  /** Matches the canvas to its box and the screen's pixels. */
  resize() {
    const ratio = Math.min(window.devicePixelRatio || 1, 3);
    this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    this.pixelRatio = ratio;
  }

  /** @param {number} time in frames @param {boolean} trails */
  paint(time, trails) {
    const {context, canvas, camera} = this;
    camera.update(canvas.width, canvas.height);
    this.motion.setTime(time);
    context.clearRect(0, 0, canvas.width, canvas.height);
    this.paintFloor();
    this.paintShadow();
    if (trails) this.paintTrails(time);
    this.paintBody();
  }

  /** Lines every half metre that fade with the distance from the target. */
  paintFloor() {
    const kStep = 0.5, kReach = 12, kNear = 0.2, {camera, context} = this;
    const cx = Math.round((camera.target[0] + camera.shift[0]) / kStep), cz = Math.round((camera.target[2] + camera.shift[2]) / kStep);
    const kLevels = 6;
    const levels = Array.from({length: kLevels}, () => new Path2D());
    for (let i = -kReach; i <= kReach; ++i)
      for (let j = -kReach; j < kReach; ++j)
        for (const along of [0, 1]) {
          const fade = 1 - Math.hypot(i, j + 0.5) / kReach;
          if (fade <= 0) continue;
          const at = (/** @type {number} */ k) => along ? camera.project((cx + k) * kStep, 0, (cz + i) * kStep)
                                                        : camera.project((cx + i) * kStep, 0, (cz + k) * kStep);
          const a = at(j), b = at(j + 1);
          if (a.depth < kNear || b.depth < kNear) continue;
          const path = levels[Math.min(kLevels - 1, Math.floor(fade * kLevels))];
          path.moveTo(a.x, a.y);
          path.lineTo(b.x, b.y);
        }
    context.strokeStyle = this.palette.line;
    context.lineWidth = this.pixelRatio;
    levels.forEach((path, k) => {
      context.globalAlpha = (k + 0.5) / kLevels;
      context.stroke(path);
    });
    context.globalAlpha = 1;
  }

  /** The body along the light onto the floor, at a quarter of the resolution: enlarging it makes it soft. */
  paintShadow() {
    const kShrink = 5, {camera, context, shadowCanvas} = this, {pose, data} = this.motion;
    shadowCanvas.width = Math.ceil(this.canvas.width / kShrink);
    shadowCanvas.height = Math.ceil(this.canvas.height / kShrink);
    const shadow = /** @type {CanvasRenderingContext2D} */ (shadowCanvas.getContext('2d'));
    shadow.fillStyle = this.palette.shadow;
    for (const part of data.parts) {
      const spots = [];
      for (const [point, radius] of part.balls) {
        const lift = pose[3 * point + 1] / kLight[1], r = radius * data.scale;
        const x = pose[3 * point] - lift * kLight[0], z = pose[3 * point + 2] - lift * kLight[2];
        for (const [c, s] of kRimDirections) {
          const p = camera.project(x + r * c, 0, z + r * s);
          if (p.depth > 0.2) spots.push({x: p.x / kShrink, y: p.y / kShrink});
        }
      }
      if (spots.length > 2) Scene.fill(shadow, hull(spots));
    }
    context.globalAlpha = 0.24;
    context.imageSmoothingQuality = 'high';
    context.drawImage(shadowCanvas, 0, 0, shadowCanvas.width * kShrink, shadowCanvas.height * kShrink);
    context.globalAlpha = 1;
  }

  /** @param {CanvasRenderingContext2D} context @param {Spot[]} outline */
  static fill(context, outline) {
    context.beginPath();
    for (const p of outline) context.lineTo(p.x, p.y);
    context.closePath();
    context.fill();
  }

  /** Where hands and feet were, thinner and fainter into the past. @param {number} time */
  paintTrails(time) {
    const kPieces = 14, {motion, camera, context} = this, {data} = motion;
    const now = Math.min(Math.floor(time), data.numFrames - 1), length = this.trailSecs / data.frameTimeSecs;
    context.lineCap = 'butt';
    context.lineJoin = 'round';
    data.trails.forEach((point, idx) => {
      context.strokeStyle = this.palette.sides[data.trailSides[idx]];
      for (let piece = 0; piece < kPieces; ++piece) {
        const newest = Math.round(now - length * piece / kPieces), oldest = Math.round(now - length * (piece + 1) / kPieces);
        const fresh = 1 - (piece + 0.5) / kPieces;
        context.globalAlpha = 0.9 * fresh ** 1.4;
        context.lineWidth = (1 + 2.4 * fresh) * this.pixelRatio;
        context.beginPath();
        if (piece === 0) this.trailPoint(motion.pose[3 * point], motion.pose[3 * point + 1], motion.pose[3 * point + 2]);
        for (let t = newest; t >= Math.max(0, oldest); --t)
          this.trailPoint(motion.coordinate(t, point, 0), motion.coordinate(t, point, 1), motion.coordinate(t, point, 2));
        context.stroke();
      }
    });
    context.globalAlpha = 1;
  }

  /** @param {number} x @param {number} y @param {number} z */
  trailPoint(x, y, z) {
    const p = this.camera.project(x, y, z);
    if (p.depth > 0.2) this.context.lineTo(p.x, p.y);
  }

  paintBody() {
    const {camera, context} = this, {pose, data} = this.motion;
    const drawn = data.parts.map((part) => {
      let depth = 0;
      const discs = part.balls.map(([point, radius]) => {
        const p = camera.project(pose[3 * point], pose[3 * point + 1], pose[3 * point + 2]);
        depth += p.depth / part.balls.length;
        return {x: p.x, y: p.y, r: radius * data.scale * p.scale};
      });
      return {discs, depth, side: part.side};
    }).filter(({depth}) => !Number.isNaN(depth));
    drawn.sort((a, b) => b.depth - a.depth);
    for (const {discs, depth, side} of drawn) {
      if (depth < 0.3) continue;
      const shade = this.palette.shades[side];
      context.fillStyle = shade.rim;
      Scene.fill(context, Scene.outline(discs, 0.9 * this.pixelRatio));
      context.fillStyle = this.gradient(discs, shade.ramp);
      Scene.fill(context, Scene.outline(discs, 0));
    }
  }

  /** @param {Disc[]} discs @param {number} grow */
  static outline(discs, grow) {
    return hull(discs.flatMap((d) => kRimDirections.map(([c, s]) => ({x: d.x + (d.r + grow) * c, y: d.y + (d.r + grow) * s}))));
  }

  /** Light of a cylinder, across a limb, and from left to right over trunk and head. @param {Disc[]} discs @param {string[]} ramp */
  gradient(discs, ramp) {
    const a = discs[0], b = discs[discs.length - 1];
    let radius = Math.max(...discs.map((d) => d.r)), dx = b.x - a.x, dy = b.y - a.y, length = Math.hypot(dx, dy);
    let x = (a.x + b.x) / 2;
    const y = (a.y + b.y) / 2;
    if (discs.length > 2 || length < 0.5 * radius) {
      const low = Math.min(...discs.map((d) => d.x - d.r)), high = Math.max(...discs.map((d) => d.x + d.r));
      radius = (high - low) / 2;
      x = (high + low) / 2;
      dx = 0, dy = -1, length = 1;
    }
    let ax = -dy / length * radius, ay = dx / length * radius;
    if (ax + ay < 0) ax = -ax, ay = -ay;
    const gradient = this.context.createLinearGradient(x - ax, y - ay, x + ax, y + ay);
    ramp.forEach((colour, i) => gradient.addColorStop(i / (ramp.length - 1), colour));
    return gradient;
  }
}
