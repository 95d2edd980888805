"""Faults that are known and open, by the name of the trial, with the reason. A trial in this list may fail; when it does not,
the run says so, and its line goes."""

KNOWN = {
    "mutant 10": "a model without bodies is refused without a line",
    "extreme distance / Length = 1e12": "a constraint that is violated at the start is refused without a line",
    "extreme universal / rotation 2 / Prescribed = 1/t": "a drive that is infinite at the start is refused without a line",
}
