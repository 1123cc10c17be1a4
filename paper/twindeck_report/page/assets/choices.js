// Modes that a person keeps or deletes at their poles, as the file modes_kept.csv that step 3 reads (keep = FILE).
class Choices {
  /// `root` holds .choices (a list) and [name=download]; `changed` draws the diagram anew.
  constructor(root, changed) {
    this.list = root.querySelector('.choices');
    this.button = root.querySelector('[name=download]');
    this.changed = changed;
    this.lines = new Map();
    this.button.addEventListener('click', () => this.download());
    this.tell();
  }

  key(panel, p) { return [panel.setup, panel.condition, p[0], p[1]].join('|'); }
  of(panel, p) { return this.lines.get(this.key(panel, p)); }
  deleted(panel, mode) { return [...this.lines.values()].some(c => c.panel === panel && c.action === 'delete' && c.mode === mode); }

  /// What a click does at a pole: of one that belongs to a mode, the mode goes; any other becomes a mode; a second click takes it back.
  offer(panel, p) {
    return this.of(panel, p) ? 'click: take the choice back' : p[4] !== null ? `click: delete mode ${p[4]}` : 'click: keep as a mode';
  }

  toggle(panel, p) {
    const key = this.key(panel, p);
    if (!this.lines.delete(key))
      this.lines.set(key, { panel, setup: panel.setup, order: p[0], frequency: p[1], damping: p[2], mode: p[4], action: p[4] !== null ? 'delete' : 'keep' });
    this.tell();
    this.changed();
  }

  tell() {
    this.list.replaceChildren(...[...this.lines].map(([key, c]) => {
      const line = document.createElement('li'), back = document.createElement('button');
      line.textContent = `${c.action === 'delete' ? `delete mode ${c.mode}` : 'keep as a mode'}: ${c.frequency.toFixed(4)} Hz, ${c.damping.toFixed(2)} %, order ${c.order} (${c.setup}, ${c.panel.condition}) `;
      back.type = 'button';
      back.textContent = 'take back';
      back.addEventListener('click', () => { this.lines.delete(key); this.tell(); this.changed(); });
      line.append(back);
      return line;
    }));
    this.button.disabled = this.lines.size === 0;
    this.button.textContent = `Download modes_kept.csv (${this.lines.size})`;
  }

  csv() {
    const cell = text => /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
    return ['setup,order,frequency_Hz,damping_ratio_pct,action', ...[...this.lines.values()].map(c => [cell(c.setup), c.order, c.frequency, c.damping, c.action].join(','))].join('\n') + '\n';
  }

  download() {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([this.csv()], { type: 'text/csv' }));
    link.download = 'modes_kept.csv';
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
}
