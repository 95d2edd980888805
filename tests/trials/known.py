"""Faults that are known and open, by the name of the trial, with the reason. A trial in this list may fail; when it does not,
the run says so, and its line goes."""

KNOWN = {
    "section-units 482121": "walls as thin as a thousandth of the chord: their solid elements lose ten digits, and GA is known to 3e-6",
}
