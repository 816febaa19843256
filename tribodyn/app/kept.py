"""What windows work on, kept by the server for pages that are loaded again or gone back to."""

import secrets

from tribodyn.app.core.document import Document
from tribodyn.app.tasks import TaskRun

#: Documents and tasks that are kept at most, and bytes of a key.
MOST_KEPT, MOST_TASKS, _KEY = 64, 32, 12


class KeptWork:
    """Documents by the keys that addresses of pages hold; tasks, the newest first."""

    def __init__(self) -> None:
        self.tasks: list[TaskRun] = []
        self._documents: dict[str, Document] = {}

    def keep(self, document: Document) -> str:
        """Keep a document as it is and as it becomes; return its key."""
        key = secrets.token_urlsafe(_KEY)
        self._documents[key] = document
        for oldest in list(self._documents)[:-MOST_KEPT]:
            del self._documents[oldest]
        return key

    def begin(self, task: TaskRun) -> None:
        """Keep a task that has begun; of those that are over the oldest are forgotten."""
        over = [one for one in self.tasks if one.state != "running"]
        self.tasks = [task, *(one for one in self.tasks if one not in over[MOST_TASKS:])]

    def copy(self, key: str) -> Document | None:
        """A document of its own as the one of a key is now, history included; None: it is not kept."""
        document = self._documents.get(key)
        return None if document is None else document.copy()
