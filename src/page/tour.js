// The tour: steps side by side that scroll by; the one that has come to rest is what the page shows.
import { $, make } from "./dom.js";
import { tour } from "./presets.js";

export class Tour {
  /** @param go  called with the fragment of a step */
  constructor(go) {
    const list = $("steps");
    list.append(...tour.map(({ title, text }, i) => make("li", {}, make("h3", { textContent: `${i + 1}. ${title}` }), make("p", { textContent: text }))));
    let at = 0;
    const show = () => {
      const step = Math.round(list.scrollLeft / list.clientWidth);
      if (step === at || !tour[step]) return;
      at = step;
      go(tour[step].fragment);
      buttons();
    };
    const buttons = () => {
      $("step-back").disabled = at === 0;
      $("step-on").disabled = at === tour.length - 1;
    };
    let timer;
    list.addEventListener("scroll", () => {
      clearTimeout(timer);
      timer = setTimeout(show, 120);
    });
    const behavior = matchMedia("(prefers-reduced-motion: reduce)").matches ? "instant" : "smooth";
    const to = (step) => list.scrollTo({ left: step * list.clientWidth, behavior });
    $("step-back").addEventListener("click", () => to(at - 1));
    $("step-on").addEventListener("click", () => to(at + 1));
    buttons();
  }
}
