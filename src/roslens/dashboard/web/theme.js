// Runs before the page is drawn, so that a chosen theme never flashes in the other colours first.
(function () {
  var root = document.documentElement;
  root.classList.add("scripted");
  try {
    var chosen = localStorage.getItem("roslens.theme");
    if (chosen === "dark" || chosen === "light") root.dataset.theme = chosen;
  } catch (refused) {
    // Storage may be forbidden: the system's choice then holds.
  }
})();
