-- The repositories that the packages of a run are in.

ALTER TABLE run ADD COLUMN repositories TEXT NOT NULL DEFAULT '[]';     -- JSON array
