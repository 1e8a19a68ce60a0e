// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// Every GLB that motex writes passes the Khronos validator without an error or a warning.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';

const validator = createRequire(import.meta.url)('gltf-validator');
const motex = process.env.MOTEX;
const mocap = fileURLToPath(new URL('../data/mocap', import.meta.url));
const quickstart = readdirSync(path.join(mocap, 'quickstart'))
  .filter((name) => name.endsWith('.bvh'))
  .map((name) => path.join(mocap, 'quickstart', name));
let folder;

before(() => (folder = mkdtempSync(path.join(tmpdir(), 'motex-gltf-'))));
after(() => rmSync(folder, { recursive: true }));

function run(...args) {
  execFileSync(motex, ['motion', ...args], { stdio: ['ignore', 'ignore', 'pipe'] });
}

async function assertValid(file) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)));
  const { numErrors, numWarnings, messages } = report.issues;
  assert.equal(numErrors + numWarnings, 0, JSON.stringify(messages.slice(0, 5), null, 1));
  assert.ok(report.info.animationCount >= 1, 'no animation');
  return report;
}

for (const clip of [quickstart[0], path.join(mocap, 'synthetic', 'ok_reference.bvh')]) {
  test(`converted ${path.basename(clip)}`, async () => {
    const out = path.join(folder, `${path.basename(clip)}.glb`);
    run('convert', clip, '-o', out);
    await assertValid(out);
  });
}

test('synthesized', async () => {
  const model = path.join(folder, 'dance.motex');
  const out = path.join(folder, 'dance.glb');
  run('learn', ...quickstart, '-o', model);
  run('synthesize', model, '-o', out, '--secs', '10');
  await assertValid(out);
});

test('a skin goes through every door', async () => {
  const tube = path.join(mocap, 'synthetic', 'skinned_tube.glb');
  const out = (name) => path.join(folder, name);
  run('convert', tube, '-o', out('tube.glb'));
  run('convert', tube, '-o', out('plain.bvh'));
  run('convert', out('tube.glb'), '-o', out('again.glb'), '--skin', tube);
  run('retarget', tube, '--to', tube, '-o', out('retargeted.glb'));
  for (const name of ['tube.glb', 'again.glb', 'retargeted.glb']) {
    const report = await assertValid(out(name));
    assert.equal(report.info.materialCount, 1, name);
    assert.equal(report.info.totalVertexCount, 54, name);
  }
});

test('an engine pack', async () => {
  const model = path.join(folder, 'pack.motex');
  run('learn', ...quickstart, '-o', model);
  run('export', model, '-o', path.join(folder, 'pack'));
  const graph = JSON.parse(readFileSync(path.join(folder, 'pack', 'graph.json'), 'utf8'));
  const report = await assertValid(path.join(folder, 'pack', 'textons.glb'));
  assert.equal(report.info.animationCount, graph.clips.length);
});
