// Formulas as HTML: reads {formula, display} as JSON, one a line, and answers {html} or {error} likewise.
'use strict';
const katex = require('/usr/share/nodejs/katex');
require('readline').createInterface({ input: process.stdin }).on('line', line => {
  const { formula, display } = JSON.parse(line);
  let answer;
  try {
    answer = { html: katex.renderToString(formula, { displayMode: display, throwOnError: true, strict: 'error' }) };
  } catch (error) {
    answer = { error: error.message };
  }
  process.stdout.write(JSON.stringify(answer) + '\n');
});
