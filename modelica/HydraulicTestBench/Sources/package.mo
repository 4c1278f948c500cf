within HydraulicTestBench;
package Sources "Commands of the bench's tests"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>Commands in percent, with their exact rate where they have one, for <code>alphaCMD</code> and
<code>alphaCMD_t</code>. <code>Constant</code> is for any input, and for a rate that is not known.</p>
<p><b>Source:</b> thesis Section 2.1.</p>
</html>"));
end Sources;
