'use strict';
// Builds the page from its data. Every text of a file becomes text of the page (textContent), never markup.

function decoded(id) {
  const holder = document.getElementById(id);
  const bytes = Uint8Array.from(atob(holder.textContent.trim()), (c) => c.charCodeAt(0));
  holder.remove();  // the text is not needed any more
  return bytes;
}

function drawTable(table, parent) {
  const shownBefore = table.rows.length <= 12;
  let into = parent;
  if (!shownBefore) {
    const details = element('details', {}, null, parent);
    element('summary', {}, `${table.title} (${table.rows.length} rows)`, details);
    into = details;
  } else {
    element('h3', {}, table.title, parent);
  }
  const holder = element('div', {class: 'table', tabindex: '0', role: 'region', 'aria-label': table.title}, null, into);
  const made = element('table', {}, null, holder);
  const isNumber = table.columns.map((_, n) => table.rows.length > 0 && table.rows.every((row) => row[n] === '' || row[n] === '\u2013' || (row[n].length < 13 && /^-?[0-9.]+(e[-+]?[0-9]+)?$/.test(row[n]))));
  // A column of long texts keeps a width at which they can be read; what does not fit on a narrow screen is scrolled to.
  const isLong = table.columns.map((column, n) => !isNumber[n] && extent(table.rows.map((row) => row[n].length))[1] > 24);
  const classOf = (n) => {
    const names = [isNumber[n] ? 'number' : '', isLong[n] ? 'long' : table.columns[n].length > 24 ? 'headed' : ''].filter((name) => name);
    return names.length ? {class: names.join(' ')} : {};
  };
  const head = element('tr', {}, null, element('thead', {}, null, made));
  table.columns.forEach((column, n) => element('th', {scope: 'col', ...classOf(n)}, column, head));
  const body = element('tbody', {}, null, made);
  for (const row of table.rows) {
    const line = element('tr', {}, null, body);
    row.forEach((cell, n) => element('td', classOf(n), cell, line));
  }
  if (table.note) element('p', {class: 'note'}, table.note, into);
}

function drawSection(section, parent) {
  const made = element('section', {id: section.id, 'aria-labelledby': `${section.id}-title`}, null, parent);
  element('h2', {id: `${section.id}-title`}, section.title, made);
  if (section.charts.length) {
    const charts = element('div', {class: 'charts'}, null, made);
    for (const chart of section.charts) {
      try {
        drawChart(chart, charts);
      } catch (error) {  // the other charts and the tables are still of use
        element('p', {class: 'warning'}, `A chart could not be drawn: ${error.message}`, charts);
      }
    }
  }
  for (const table of section.tables) drawTable(table, made);
  if (section.words.length) {
    const details = element('details', section.words.length <= 3 ? {open: ''} : {}, null, made);
    element('summary', {}, 'Notes of the programs', details);
    const list = element('ul', {class: 'words'}, null, details);
    for (const words of section.words) element('li', {}, words, list);
  }
}

function drawPictures(data, parent) {
  if (!data.pictures.length) return;
  const made = element('section', {id: 'pictures', 'aria-labelledby': 'pictures-title'}, null, parent);
  element('h2', {id: 'pictures-title'}, 'Pictures', made);
  const grid = element('div', {class: 'pictures'}, null, made);
  for (const picture of data.pictures) {
    const figure = element('figure', {}, null, grid);
    const image = element('img', {alt: picture.caption, loading: 'lazy'}, null, figure);
    image.src = 'data:image/png;base64,' + document.getElementById(picture.blob).textContent.trim();
    const caption = element('figcaption', {class: 'note'}, `${picture.caption} `, figure);
    element('a', {href: picture.link}, picture.file, caption);
  }
}

function drawContents(parent) {
  const list = element('ul', {}, null, parent);
  for (const section of document.querySelectorAll('main section:not([hidden])')) {
    const title = section.querySelector('h2');
    if (title) element('a', {href: `#${section.id}`}, title.textContent, element('li', {}, null, list));
  }
}

function drawPage() {
  const data = JSON.parse(document.getElementById('report-data').textContent);
  const sections = document.getElementById('sections');
  try {
    drawMotion(data, document.getElementById('motion'));
  } catch (error) {  // what was found can be read without motion
    element('p', {class: 'warning'}, `The motion cannot be shown: ${error.message}`, document.getElementById('motion'));
  }
  for (const section of data.sections) {
    if (section.id === 'provenance') drawPictures(data, sections);
    drawSection(section, sections);
  }
  if (data.notes.length) {
    const made = element('section', {id: 'missing', 'aria-labelledby': 'missing-title'}, null, sections);
    element('h2', {id: 'missing-title'}, 'What could not be shown', made);
    const list = element('ul', {class: 'words'}, null, made);
    for (const note of data.notes) element('li', {}, note, list);
  }
  drawContents(document.getElementById('contents'));
  document.documentElement.dataset.ready = 'yes';
}

drawPage();
