// The state in the page's address: a link reproduces it, and Back takes a change back.
import { fromFragment, toFragment } from "./page_state.js";

const pause = 250;  // ms
const steps = (fragment) => fragment.replace(/(^|&)(at|isochrone|theme)=[^&]*/g, "");

export class Address {
  /**
   * @param known  of the library, with the names of the views
   * @param use    called with the state of an address that the reader has gone to
   */
  constructor(store, known, use) {
    this.store = store;
    addEventListener("hashchange", () => {
      clearTimeout(this.timer);
      if (location.hash.slice(1) !== toFragment(store.state)) use(fromFragment(location.hash, known));
    });
  }

  rememberSoon() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.remember(), pause);
  }

  remember() {
    clearTimeout(this.timer);
    const fragment = toFragment(this.store.state);
    const before = location.hash.slice(1);
    const change = this.settled && steps(before) !== steps(fragment) ? "pushState" : "replaceState";
    this.settled = true;
    try {
      history[change](null, "", `#${fragment}`);
    } catch {
      // A page without an address of its own, such as one inside another page.
    }
  }

  get link() {
    this.remember();
    return location.hash ? location.href : null;
  }
}
