"""Oracle: messages written by hand."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import commit_message  # noqa: E402


class CommitMessage(unittest.TestCase):
    def test_a_good_message_has_no_complaint(self):
        self.assertEqual(commit_message.complaints("Read times of day over midnight\n\nA step back by 24 h less one sample is midnight.\n"), [])

    def test_each_habit_is_held(self):
        self.assertEqual(len(commit_message.complaints("x" * 73 + "\n\nwhy")), 1)
        self.assertEqual(len(commit_message.complaints("Mend it.\n\nwhy")), 1)
        self.assertEqual(len(commit_message.complaints("Mend it")), 1)
        self.assertEqual(len(commit_message.complaints("Mend it\nat once")), 1)


if __name__ == "__main__":
    unittest.main()
