"""Adds up the test results that gtest, rosunit and rostest left as XML, and says so in one line."""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def outcome(case):
    if case.find("failure") is not None or case.find("error") is not None:
        return "failed"
    if case.find("skipped") is not None or case.get("status") == "notrun" or case.get("result") == "skipped":
        return "skipped"
    return "passed"


def main(folder):
    count = {"passed": 0, "failed": 0, "skipped": 0}
    for path in sorted(pathlib.Path(folder).rglob("*.xml")):
        # rostest repeats in its own file what the test program has written in rosunit-*.xml.
        if path.name.startswith("rostest-"):
            continue
        try:
            cases = list(ElementTree.parse(path).getroot().iter("testcase"))
        except ElementTree.ParseError:
            cases = []
        if not cases:
            print(f"{path.name}: no test ran")
            count["failed"] += 1
        for case in cases:
            result = outcome(case)
            count[result] += 1
            if result == "failed":
                print(f"failed: {path.stem} {case.get('classname')}.{case.get('name')}")
    print("{passed} passed, {failed} failed, {skipped} skipped".format(**count))
    return 1 if count["failed"] or not count["passed"] else 0


sys.exit(main(sys.argv[1]))
