within HydraulicTestBench;
package Constants "Mathematical constants"
  extends Icons.Package;
  constant Real pi(final unit="1") = 2*asin(1) "Circle number";
  annotation(Documentation(info="<html>
<p>Instead of <code>Modelica.Constants</code>, so that the library loads alone.</p>
<p><b>Source:</b> mathematics.</p>
</html>"));
end Constants;
