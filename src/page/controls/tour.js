// The tour: steps side by side that scroll by; the one that has come to rest is what the page shows.
import { $, isStill, make } from "../dom.js";
import { tour } from "../state/presets.js";

export class Tour {
  at = 0;

  /** @param go  called with the fragment of a step, and its number */
  constructor(go) {
    const list = $("steps");
    list.append(...tour.map(({ title, text }, i) => make("li", {}, make("h3", { textContent: `${i + 1}. ${title}` }), make("p", { textContent: text }))));
    this.list = list;
    let timer;
    list.addEventListener("scroll", () => {
      clearTimeout(timer);
      timer = setTimeout(() => {
        const step = Math.round(list.scrollLeft / list.clientWidth);
        if (step !== this.at && tour[step]) go(tour[step].fragment, step);
      }, 120);
    });
    $("step-back").addEventListener("click", () => this.to(this.at - 1));
    $("step-on").addEventListener("click", () => this.to(this.at + 1));
  }

  to(step) {
    this.list.scrollTo({ left: step * this.list.clientWidth, behavior: isStill() ? "instant" : "smooth" });
  }

  /** Shows the step of the state. */
  show(step) {
    $("step-back").disabled = step === 0;
    $("step-on").disabled = step >= tour.length - 1;
    if (step !== this.at) this.to(this.at = step);
  }
}
