"""Faults that are known and open, by the name of the trial, with the reason. A trial in this list may fail; when it does not,
the run says so, and its line goes."""

KNOWN = {}
