within HydraulicTestBench.Interfaces.Neutral;
model Compressibility "Nothing softer than the oil itself"
  extends PartialCompressibility;
equation
  kappa1 = 0;
  kappa2 = 0;
  annotation(Documentation(info="<html>
<p>The base model's filling of the slot <code>Interfaces.PartialCompressibility</code>: exactly nothing. A compiler
removes it.</p>
<p><b>Source:</b> thesis Eq. 3.1 to 3.20, which have no such term.</p>
</html>"));
end Compressibility;
