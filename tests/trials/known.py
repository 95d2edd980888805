"""Faults that are known and open, by the name of the trial, with the reason. A trial in this list may fail; when it does not,
the run says so, and its line goes."""

KNOWN = {
    "placed-turned 47": "rolling friction between bodies that a redundant loop locks: what turns in stages alone, 5e-5 of the speed, "
                        "depends on which rows are left out",
}
