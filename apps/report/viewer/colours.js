// The colour map viridis, at 16 places. People who do not see all colours can read it, too.
const viridis = [
  [68, 1, 84], [72, 26, 108], [71, 47, 125], [65, 68, 135], [57, 86, 140], [49, 104, 142], [42, 120, 142],
  [35, 136, 142], [31, 152, 139], [34, 168, 132], [53, 183, 121], [84, 197, 104], [122, 209, 81], [165, 219, 54],
  [210, 226, 27], [253, 231, 37]];
const withoutNumber = [150, 150, 150];

// Writes the colour of a share from 0 to 1 to colours[at], colours[at + 1] and colours[at + 2].
function putColour(share, colours, at) {
  const place = Math.min(Math.max(share, 0), 1) * (viridis.length - 1);
  const below = Math.min(Math.floor(place), viridis.length - 2), part = place - below;
  for (let c = 0; c < 3; ++c)
    colours[at + c] = Number.isFinite(share)
      ? viridis[below][c] + part * (viridis[below + 1][c] - viridis[below][c]) : withoutNumber[c];
}

// The map as a background of the legend.
function colourBar() {
  return "linear-gradient(to right," + viridis.map(colour => `rgb(${colour})`).join(",") + ")";
}
