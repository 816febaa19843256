"""What windows work on, kept by the server for pages that are loaded again or gone back to."""

import secrets

from tribodyn.app.core.document import Document

#: Documents that are kept at most, and bytes of a key.
MOST_KEPT, _KEY = 64, 12


class KeptDocuments:
    """Documents by the keys that addresses of pages hold; those kept longest ago are forgotten."""

    def __init__(self) -> None:
        self._documents: dict[str, Document] = {}

    def keep(self, document: Document) -> str:
        """Keep a document as it is and as it becomes; return its key."""
        key = secrets.token_urlsafe(_KEY)
        self._documents[key] = document
        for oldest in list(self._documents)[:-MOST_KEPT]:
            del self._documents[oldest]
        return key

    def copy(self, key: str) -> Document | None:
        """A document of its own as the one of a key is now, history included; None: it is not kept."""
        document = self._documents.get(key)
        return None if document is None else document.copy()
