// The state in the page's address: a link reproduces it, and Back takes a change back.
import { fromFragment, toFragment } from "./page_state.js";

const pause = 250;  // ms
const steps = (fragment) => fragment.replace(/(^|&)(at|isochrone|theme)=[^&]*/g, "");

export class Address {
  /** @param {Store} store @param {Hero} hero */
  constructor(store, hero) {
    this.store = store;
    this.hero = hero;
    // All changes while the reader holds something are one step of the history.
    addEventListener("pointerdown", () => {
      store.held = true;
      clearTimeout(this.timer);
    }, true);
    // The event pointermove without a button shows that the button was released outside the page.
    for (const end of /** @type {const} */ (["pointerup", "pointercancel", "pointermove"])) {
      addEventListener(end, ({ buttons }) => {
        if (!store.held || buttons !== 0) return;
        store.release();
        this.rememberSoon();
      }, true);
    }
    addEventListener("hashchange", () => {
      clearTimeout(this.timer);
      /** @type {string[]} */
      const problems = [];
      const asked = fromFragment(location.hash, store.library, problems);
      if (location.hash.slice(1) !== this.fragment()) store.ask((state) => Object.assign(state, asked), undefined, problems);
    });
  }

  rememberSoon() {
    clearTimeout(this.timer);
    if (!this.store.held) this.timer = setTimeout(() => this.remember(), pause);
  }

  remember() {
    clearTimeout(this.timer);
    const fragment = this.fragment();
    const before = location.hash.slice(1);
    // Inside another page, the history belongs to that page.
    const change = this.settled && top === window && steps(before) !== steps(fragment) ? "pushState" : "replaceState";
    this.settled = true;
    try {
      history[change](null, "", this.linkTo(fragment));
    } catch {
      // A page without an address of its own, such as one inside another page.
    }
  }

  fragment() { return toFragment(this.store.state, this.hero.asked !== null); }
  linkTo(fragment) { return `${location.href.split("#")[0]}${fragment && "#"}${fragment}`; }

  /** Returns the link to a state; null if the page has no address. */
  linkOf(/** @type {State} */ state) {
    this.remember();
    return /^(http|file)/.test(location.protocol) ? this.linkTo(toFragment(state, this.hero.asked !== null)) : null;
  }
}
