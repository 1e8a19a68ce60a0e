// SPDX-FileCopyrightText: 2026 The motex authors
// SPDX-License-Identifier: MIT
// node validate.mjs FILE.glb...   exits 1 when the glTF validator finds an error or a warning in any of them.
// First: npm ci
import { readFile } from "node:fs/promises";
import { validateBytes } from "gltf-validator";

const files = process.argv.slice(2);
if (files.length === 0) {
  console.error("usage: node validate.mjs FILE.glb...");
  process.exit(2);
}
let bad = 0;
for (const file of files) {
  const report = await validateBytes(new Uint8Array(await readFile(file)), { uri: file, maxIssues: 100 });
  const { numErrors, numWarnings, numInfos, messages } = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos`);
  for (const m of messages) console.log(`  ${["error", "warning", "info", "hint"][m.severity]} ${m.code} ${m.pointer ?? ""}: ${m.message}`);
  bad += numErrors + numWarnings;
}
process.exit(bad > 0 ? 1 : 0);
