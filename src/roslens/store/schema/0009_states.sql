-- Past revisions of a workspace of several repositories: a JSON array of the place and the commit of each.

ALTER TABLE revision ADD COLUMN commits TEXT NOT NULL DEFAULT '[]';
