"""Who may see the pages and who may act through them: tokens, roles, origins, rates and a record of it."""
