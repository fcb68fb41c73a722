# Every target lives in Code/Makefile; this file only lets you call them from the top folder.
.DEFAULT_GOAL := all
.PHONY: all
all:
	@$(MAKE) --no-print-directory -C Code all
%:
	@$(MAKE) --no-print-directory -C Code $@
