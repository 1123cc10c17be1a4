// Sets the parts going, each where its place is on the page, and keeps the table of contents in step with scrolling.
const data = JSON.parse(document.getElementById('twindeck-data').textContent);
const page = window.twindeck = {};
const [modesAt, whereAt, polesAt] = ['mode-shapes', 'where', 'poles'].map(id => document.getElementById(id));
if (modesAt && data.modes) page.modes = new ModeShapes(modesAt, data.modes);
if (whereAt && data.where) page.where = new Where(whereAt, data.where, data.modes.meshes[data.where.mesh]);
if (polesAt && data.poles) page.poles = new Stabilisation(polesAt, data.poles);

// Sections load folded. A link to one opens it, and printing opens all.
const unfold = () => {
  const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!target) return;
  for (let at = target.querySelector(':scope > details') || target; at; at = at.parentElement) if (at.tagName === 'DETAILS') at.open = true;
  target.scrollIntoView();
};
window.addEventListener('hashchange', unfold);
for (const a of document.querySelectorAll('a[href^="#"]')) a.addEventListener('click', () => { if (a.hash === location.hash) unfold(); });
unfold();
let folded = [];
window.addEventListener('beforeprint', () => {
  folded = [...document.querySelectorAll('section > details:not([open])')];
  for (const d of folded) d.open = true;
});
window.addEventListener('afterprint', () => { for (const d of folded) d.open = false; });

const links = new Map([...document.querySelectorAll('nav.contents a')].map(a => [a.hash.slice(1), a]));
const inView = new Set();
const watch = new IntersectionObserver(entries => {
  for (const e of entries) e.isIntersecting ? inView.add(e.target.id) : inView.delete(e.target.id);
  const first = [...links.keys()].find(id => inView.has(id));
  for (const [id, a] of links) a.classList.toggle('here', id === first);
}, { rootMargin: '-10% 0px -60% 0px' });
document.querySelectorAll('main section[id]').forEach(s => watch.observe(s));

for (const box of document.querySelectorAll('input[data-filter]')) {
  const rows = document.querySelectorAll(`#${box.dataset.filter} tbody tr`);
  const list = document.getElementById(box.dataset.filter);
  box.addEventListener('input', () => {
    list.classList.toggle('short', box.value === '');
    const words = box.value.toLowerCase().split(/\s+/).filter(Boolean);
    for (const row of rows) row.hidden = !words.every(w => row.textContent.toLowerCase().includes(w));
  });
}
for (const button of document.querySelectorAll('button[data-more]'))
  button.addEventListener('click', () => {
    const open = document.getElementById(button.dataset.more).classList.toggle('short');
    button.textContent = open ? button.dataset.all : 'show fewer';
  });

for (const figure of document.querySelectorAll('.gallery figure')) {
  const turn = () => figure.classList.toggle('large');
  figure.addEventListener('click', turn);
  figure.addEventListener('keydown', e => { if (e.key === 'Enter') turn(); });
}
