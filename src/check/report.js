'use strict';
(() => {
const table = document.querySelector('.results');
const body = table.tBodies[0];
const rows = [...body.rows];
const chips = [...document.querySelectorAll('.filter button')];
const search = document.querySelector('.filter input');
const shown = document.querySelector('.filter output');

/* No status chosen: all are shown. Words of the search are all to be in the name. */
function filter() {
	const statuses = chips.filter(chip => chip.getAttribute('aria-pressed') === 'true')
		.map(chip => chip.dataset.status);
	const words = search.value.toLowerCase().split(/\s+/);
	let count = 0;
	for (const row of rows) {
		const name = row.dataset.name.toLowerCase();
		const match = (statuses.length === 0 || statuses.includes(row.dataset.status)) &&
			words.every(word => name.includes(word));
		row.hidden = !match;
		count += match;
	}
	shown.textContent = `${count} of ${rows.length} cases`;
}

/* A value of -1 is none: always last. */
function key(row, column) {
	const cell = row.cells[column];
	return cell.dataset.value === undefined ? cell.textContent : Number(cell.dataset.value);
}

function compare(a, b, sign) {
	if (typeof a === 'string')
		return sign * a.localeCompare(b, 'en', {numeric: true});
	return (a < 0) - (b < 0) || sign * (a - b);
}

function sort(heading) {
	const column = heading.cellIndex;
	const descending = heading.getAttribute('aria-sort') === 'ascending';
	for (const other of table.tHead.rows[0].cells)
		other.removeAttribute('aria-sort');
	heading.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
	rows.sort((a, b) => compare(key(a, column), key(b, column), descending ? -1 : 1));
	body.append(...rows);
}

for (const chip of chips)
	chip.addEventListener('click', () => {
		chip.setAttribute('aria-pressed', chip.getAttribute('aria-pressed') !== 'true');
		filter();
	});
search.addEventListener('input', filter);
for (const heading of table.tHead.rows[0].cells)
	heading.firstElementChild.addEventListener('click', () => sort(heading));
for (const slider of document.querySelectorAll('.stage input'))
	slider.addEventListener('input', () => {
		slider.parentElement.style.setProperty('--at', `${slider.value}%`);
		slider.setAttribute('aria-valuetext', `${slider.value} % result`);
	});
filter();
})();
