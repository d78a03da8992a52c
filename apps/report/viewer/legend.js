// The colours and what they mean: the least and the greatest value of all frames.
class Legend {
  constructor() {
    this.name = element("b");
    this.low = element("span");
    this.high = element("span");
    const bar = element("div", {class: "viewer-bar"});
    bar.style.background = colourBar();
    this.place = element("div", {class: "viewer-legend"}, this.name, bar,
                         element("div", {class: "viewer-ends"}, this.low, this.high));
  }

  show(quantity) {
    this.name.textContent = quantity.unit ? `${quantity.label}, ${quantity.unit}` : quantity.label;
    this.low.textContent = withUnit(quantity.range[0], "");
    this.high.textContent = withUnit(quantity.range[1], "");
  }
}
