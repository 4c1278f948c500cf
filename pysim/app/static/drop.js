// Takes files and folders, dropped or chosen, and hands them to the server piece by piece.
async function below(entry, path) {
  if (entry.isFile) {
    const file = await new Promise((done, failed) => entry.file(done, failed));
    return [{ path: path + entry.name, file }];
  }
  const reader = entry.createReader();
  const found = [];
  for (;;) {
    const part = await new Promise((done, failed) => reader.readEntries(done, failed));
    if (!part.length) break;
    for (const one of part) found.push(...(await below(one, `${path}${entry.name}/`)));
  }
  return found;
}

const send = (method, url, body, progress) =>
  new Promise((done) => {
    const request = new XMLHttpRequest();
    request.open(method, url);
    request.upload.onprogress = (event) => progress?.(event.loaded);
    request.onload = () => done({ ok: request.status < 300, asks: request.status === 202, text: request.responseText });
    request.onerror = () => done({ ok: false, text: "the file cannot be read, or pysim app does not run any more; drop it again" });
    request.send(body);
  });

export default {
  template: `
    <div class="drop" :class="{ over, busy }" @dragover.prevent="over = true" @dragleave="over = false" @drop.prevent="dropped">
      <div class="drop-words" aria-live="polite">
        <div class="drop-title">{{ question || (busy ? state : title) }}</div>
        <div class="drop-hint" v-if="!busy && !question">{{ hint }}</div>
        <div class="bar" v-if="busy && !question" role="progressbar" :aria-valuenow="percent"><i :style="{ width: percent + '%' }"></i></div>
      </div>
      <div class="drop-buttons" v-if="question">
        <button type="button" class="button main" @click="answered(true)">Replace it</button>
        <button type="button" class="button" @click="answered(false)">Keep the one that is there</button>
      </div>
      <div class="drop-buttons" v-else-if="!busy">
        <button type="button" class="button" @click="$refs.folder.click()">Choose a folder</button>
        <button type="button" class="button" @click="$refs.files.click()">Choose files</button>
      </div>
      <input ref="files" class="drop-input" type="file" multiple tabindex="-1" aria-label="files" @change="chosen" />
      <input ref="folder" class="drop-input" type="file" webkitdirectory tabindex="-1" aria-label="folder" @change="chosen" />
    </div>`,
  props: { title: String, hint: String, bytes: Number, files: Number, limit: String },
  data: () => ({ over: false, busy: false, state: "", percent: 0, question: "" }),
  methods: {
    async dropped(event) {
      this.over = false;
      if (this.busy) return;
      const entries = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
      const found = [];
      for (const entry of entries) found.push(...(await below(entry, "")));
      await this.upload(found.length ? found : [...event.dataTransfer.files].map((file) => ({ path: file.name, file })));
    },
    async chosen(event) {
      const found = [...event.target.files].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
      event.target.value = "";
      await this.upload(found);
    },
    async upload(found) {
      if (!found.length) return;
      const size = found.reduce((sum, one) => sum + one.file.size, 0);
      if (size > this.bytes || found.length > this.files) {
        const what = `${(size / 2 ** 20).toFixed(0)} MB in ${found.length} files`;
        this.$emit("refused", `${what} are too much; drop at most ${this.limit}`);
        return;
      }
      this.busy = true;
      this.percent = 0;
      const begun = await send("POST", "/upload");
      let done = 0;
      let answer = begun;
      for (const { path, file } of begun.ok ? found : []) {
        this.state = `Taking over ${path}`;
        const url = `/upload/${begun.text}?name=${encodeURIComponent(path)}`;
        const progress = (part) => (this.percent = Math.round((100 * (done + part)) / (size || 1)));
        answer = await send("PUT", url, file, progress);
        done += file.size;
        if (!answer.ok) break;
      }
      if (answer.ok) {
        this.state = "Reading";
        answer = await send("POST", `/upload/${begun.text}/done?files=${found.length}`);
        if (answer.asks) {
          this.question = answer.text;
          const sure = await new Promise((told) => (this.answered = told));
          this.question = "";
          answer = { ok: true, text: "The data set that is there was kept" };
          if (sure) answer = await send("POST", `/upload/${begun.text}/done?files=${found.length}&sure=1`);
        }
      }
      this.busy = false;
      this.$emit(answer.ok ? "taken" : "refused", answer.text);
    },
  },
};
