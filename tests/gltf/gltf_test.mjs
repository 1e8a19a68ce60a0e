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
