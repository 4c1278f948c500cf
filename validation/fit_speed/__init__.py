"""How long a complete fit takes."""
