// What pages that are read and used without JavaScript have of it: light or dark, and the place in the navigation.

import { startKeys } from "../keys.js";
import { showPlace, startTheme } from "../shell.js";

startTheme();
showPlace();
startKeys();
