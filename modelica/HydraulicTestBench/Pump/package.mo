within HydraulicTestBench;
package Pump "The pump with its swash plate control"
  extends Icons.Package;
  annotation(Documentation(info="<html>
<p>The classes to compile are <code>FreeGreyBox</code> and <code>LockedGreyBox</code>; both are
<code>SwashPlateControl</code>, with the parameter set of Table 4.6 or 4.5. The rest are its parts.</p>
<p><b>Source:</b> thesis Chapter 3.</p>
</html>"));
end Pump;
